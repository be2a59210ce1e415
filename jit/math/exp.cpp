// jit/math/exp.cpp: exp and exp2.
#include "jit/math/exp_p.h"

#include "jit/math/coefficients_p.h"

namespace kinora::jit::math {
namespace {

// value 2^k where t = kRoundingMagic + k, -252 <= k <= 254; the one rounding is the last, so that
// subnormal results are right.
Num scale_wide(Num value, Num t) {
    Int k = bits(t) - bits_of(kRoundingMagic);
    Int first = shift_right_signed(k, 1);
    Int second = k - first;
    return value * from_bits((first + 127) << 23) * from_bits((second + 127) << 23);
}

// 1 + h + low where |h| < 1, |low| small.
Num one_plus(Num h, Num low) {
    Num sum = 1.0f + h;
    return sum + (((1.0f - sum) + h) + low);
}

// Twice: the fast tier puts k - 1 into the exponent, so that k = 128 still is finite and what is
// too large becomes infinite in the multiplication. Results below 2^-126 are 0.
constexpr float kFastMagic = kRoundingMagic + 126;

Num scale_fast(Num value, Num t) {
    return (value + value) * from_bits(bits(t) << 23);
}

Num exp_precise(Num x) {
    x = at_most(num(x, 89.0f), at_least(num(x, -104.0f), x));
    Num t = fma(x, kLog2e[0], kRoundingMagic);
    Num minus_k = kRoundingMagic - t;
    Num exact = fma(minus_k, kLn2[0], x);
    Num r = fma(minus_k, kLn2[1], exact);
    Num low = fma(minus_k, kLn2[1], exact - r);
    return scale_wide(one_plus(r, fma(r * r, horner(r, kExp), low)), t);
}

Num exp_fast(Num x) {
    x = at_most(num(x, 89.0f), at_least(num(x, -87.3f), x));
    Num t = fma(x, kLog2e[0], kFastMagic);
    Num minus_k = kFastMagic - t;
    Num r = fma(minus_k, kLn2[1], fma(minus_k, kLn2[0], x));
    return scale_fast(fma(r, horner(r, kExpFast), 1.0f), t);
}

}  // namespace

Num exp2_of_sum(Num hi, Num lo) {
    hi = at_most(num(hi, 150.0f), at_least(num(hi, -160.0f), hi));
    Num t = hi + kRoundingMagic;
    Num rest = hi + (kRoundingMagic - t);  // exact
    Num r = rest + lo;
    lo = (rest - r) + lo;  // rest is a multiple of lo's last place
    Num h = r * kLn2[0];
    Num h_low = fma(r, kLn2[0], -h) + fma(r, kLn2[1], lo * kLn2[0]);
    return scale_wide(one_plus(h, fma(r * r, horner(r, kExp2), h_low)), t);
}

Num exp2_fast(Num x) {
    x = at_most(num(x, 129.0f), at_least(num(x, -126.0f), x));
    Num t = x + kFastMagic;
    Num r = x + (kFastMagic - t);
    return scale_fast(fma(r, horner(r, kExp2Fast), 1.0f), t);
}

Value exp(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "exp", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? exp_precise(p[0]) : exp_fast(p[0]);
    });
}

Value exp2(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "exp2", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? exp2_of_sum(p[0], num(p[0], 0.0f)) : exp2_fast(p[0]);
    });
}

}  // namespace kinora::jit::math
