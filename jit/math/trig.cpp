// jit/math/trig.cpp: sin, cos, tan.
#include "jit/math/coefficients_p.h"
#include "jit/math/reduce_p.h"

namespace kinora::jit::math {
namespace {

// Up to here k pi/2 in three floats (Cody and Waite) leaves a remainder that is right to the last
// bit; beyond, exact arithmetic takes over.
constexpr float kDirectLimit = 8192.0f;

// The exact reduction of the lanes of `mask`, a function of the module: hi, lo and quadrant.
std::vector<Value> reduce_exactly(Num x, Value mask) {
    Value args[] = {x.v};
    auto write = [](std::span<const Num> p) {
        Reduced r = reduce_huge(p[0]);
        return std::vector<Value>{r.hi.v, r.lo.v, r.quadrant.v};
    };
    return call_function(*x.b, "trig_reduce", {Type::F, Type::F, Type::I}, mask, args, write);
}

// Replaces what the direct reduction gave by the exact one where |x| is large.
Reduced with_huge(Num x, Reduced direct) {
    Builder& b = *x.b;
    Value huge = (kDirectLimit < abs(x)).v;
    b.begin_if(huge);
    std::vector<Value> exact = reduce_exactly(x, huge);
    b.end_if();
    return {merge({&b, exact[0]}, direct.hi), merge({&b, exact[1]}, direct.lo),
            merge({&b, exact[2]}, direct.quadrant)};
}

Reduced reduce(Num x) {
    Num t = fma(x, 2 / 3.14159265358979f, kRoundingMagic);
    Num minus_k = kRoundingMagic - t;
    Num r = fma(minus_k, kHalfPi[0], x);  // exact
    Num p = minus_k * kHalfPi[1];
    Num p_low = fma(minus_k, kHalfPi[1], -p);
    Num hi = r + p;
    Num lo = (p - (hi - r)) + fma(minus_k, kHalfPi[2], p_low);  // r is a multiple of p's last place
    return with_huge(x, {hi, lo, bits(t)});
}

// sin and cos of hi + lo as sums of two floats, |hi| <= pi/4.
struct SinCos {
    Num sin, sin_low;
    Num cos, cos_low;
};
SinCos sin_cos(Num hi, Num lo) {
    Num z = hi * hi;
    Num half = 0.5f * z;
    Num low = fma(-half, lo, lo);  // lo cos(hi)
    SinCos out;
    out.sin = hi;
    out.sin_low = fma(z * hi, horner(z, kSin), low);
    out.cos = 1.0f - half;
    Num rounding = fma(fma(hi, hi, -z), 0.5f, hi * lo);  // of z / 2, and lo sin(hi)
    out.cos_low = ((1.0f - out.cos) - half) + fma(z * z, horner(z, kCos), -rounding);
    return out;
}

// The sine of the quadrant's angle: odd quadrants take the cosine, quadrants 2 and 3 the minus.
Num of_quadrant(Num sine, Num cosine, Int quadrant) {
    Num value = select(bit_set(quadrant, 0), cosine, sine);
    return flip_sign(value, (quadrant & 2) << 30);
}

Num sin_precise(Num x, int quadrants_ahead) {
    Reduced r = reduce(x);
    SinCos sc = sin_cos(r.hi, r.lo);
    return of_quadrant(sc.sin + sc.sin_low, sc.cos + sc.cos_low, r.quadrant + quadrants_ahead);
}

// sin r for |r| <= pi/2 in one polynomial.
Num sin_wide(Num r) {
    Num z = r * r;
    return fma(z * r, horner(z, kSinWide), r);
}

// x - k pi for the k (an integer or half of an odd one) with the opposite sign.
Num minus_multiple_of_pi(Num x, Num minus_k) {
    return fma(minus_k, kPi[2], fma(minus_k, kPi[1], fma(minus_k, kPi[0], x)));
}

Num huge_sin(Num x, Num direct, int quadrants_ahead) {
    Builder& b = *x.b;
    Value huge = (kDirectLimit < abs(x)).v;
    b.begin_if(huge);
    std::vector<Value> exact = reduce_exactly(x, huge);
    SinCos sc = sin_cos({&b, exact[0]}, {&b, exact[1]});
    Int quadrant = Int{&b, exact[2]} + quadrants_ahead;
    Num value = of_quadrant(sc.sin + sc.sin_low, sc.cos + sc.cos_low, quadrant);
    b.end_if();
    return merge(value, direct);
}

// sin x = (-1)^k sin(x - k pi)
Num sin_fast(Num x) {
    Num t = fma(x, 1 / 3.14159265358979f, kRoundingMagic);
    Num r = minus_multiple_of_pi(x, kRoundingMagic - t);
    return huge_sin(x, flip_sign(sin_wide(r), bits(t) << 31), 0);
}

// cos x = (-1)^(k+1) sin(x - (k + 1/2) pi); the magic is odd to count k + 1.
Num cos_fast(Num x) {
    constexpr float magic = kRoundingMagic + 1;
    Num t = fma(x, 1 / 3.14159265358979f, -0.5f) + magic;
    Num r = minus_multiple_of_pi(x, (magic - t) - 0.5f);
    return huge_sin(x, flip_sign(sin_wide(r), bits(t) << 31), 1);
}

// n / d with both as sums of two floats; the quotient is corrected by its remainder.
Num divide(Num n, Num n_low, Num d, Num d_low) {
    Num q = n / d;
    Num remainder = fma(-q, d, n) + fma(-q, d_low, n_low);
    return q + remainder / d;
}

struct TwoFloats {
    Num hi, lo;
};
// hi + lo where |hi| >= |lo| (Dekker).
TwoFloats renormalize(Num hi, Num lo) {
    Num sum = hi + lo;
    return {sum, (hi - sum) + lo};
}

// Odd quadrants: tan(r + pi/2) = -cos r / sin r.
Num tan_precise(Num x) {
    Reduced r = reduce(x);
    SinCos sc = sin_cos(r.hi, r.lo);
    TwoFloats s = renormalize(sc.sin, sc.sin_low);
    TwoFloats c = renormalize(sc.cos, sc.cos_low);
    Mask odd = bit_set(r.quadrant, 0);
    Num tangent = divide(select(odd, c.hi, s.hi), select(odd, c.lo, s.lo), select(odd, s.hi, c.hi),
                         select(odd, s.lo, c.lo));
    return flip_sign(tangent, r.quadrant << 31);
}

Num tan_fast(Num x) {
    Num t = fma(x, 2 / 3.14159265358979f, kRoundingMagic);
    Num minus_k = kRoundingMagic - t;
    Num near = fma(minus_k, kHalfPi[2], fma(minus_k, kHalfPi[1], fma(minus_k, kHalfPi[0], x)));
    Reduced r = with_huge(x, {near, num(x, 0.0f), bits(t)});
    Num z = r.hi * r.hi;
    Num tangent = fma(z * r.hi, horner(z, kTan), r.hi);
    Mask odd = bit_set(r.quadrant, 0);
    return select(odd, -1.0f, tangent) / select(odd, tangent, num(x, 1.0f));
}

}  // namespace

Value sin(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "sin", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? sin_precise(p[0], 0) : sin_fast(p[0]);
    });
}

Value cos(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "cos", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? sin_precise(p[0], 1) : cos_fast(p[0]);
    });
}

Value tan(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "tan", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? tan_precise(p[0]) : tan_fast(p[0]);
    });
}

}  // namespace kinora::jit::math
