// jit/math/arc.cpp: asin, acos, atan, atan2, and inversesqrt.
#include <limits>

#include "jit/math/coefficients_p.h"
#include "jit/math/expr_p.h"

namespace kinora::jit::math {
namespace {

// j pi/4 + angle + low where j is an integer 0 .. 4 and |angle| <= pi/4.
Num plus_eighths(Num j, Num angle, Num low) {
    Num base = j * kQuarterPi[0];  // exact
    Num sum = base + angle;
    return sum + (((base - sum) + angle) + fma(j, kQuarterPi[1], low));
}

// The angle of the direction (x, y) from the axis of x, 0 .. pi/2, for 0 <= x, y, the larger of
// them a normal number below 2^126; as eighths of the circle and a rest |angle| <= pi/8.
struct Octant {
    Num eighths;  // 0, 1 or 2
    Num angle;
    Num low;  // 0 in the fast tier
};
Octant octant(Num x, Num y, Tier tier) {
    Mask steep = x < y;
    Num n = select(steep, x, y);
    Num d = select(steep, y, x);
    // atan(n/d) = pi/4 + atan((n - d)/(n + d)) beyond tan(pi/8)
    Mask middle = d * 0.41421356f < n;
    Num difference = n - d;
    Num sum = n + d;
    Num top = select(middle, difference, n);
    Num bottom = select(middle, sum, d);
    Num q = top / bottom;
    Num q_low = num(x, 0.0f);
    if (tier == Tier::Precise) {
        Num top_low = (n - (difference + d));  // n - d - difference: |d| >= |n|
        Num bottom_low = (d - sum) + n;
        Num rest = fma(-q, select(middle, bottom_low, 0.0f), select(middle, top_low, 0.0f));
        q_low = (fma(-q, bottom, top) + rest) / bottom;
    }
    Num z = q * q;
    Num tail = z * q;
    tail = tier == Tier::Precise ? fma(tail, horner(z, kAtan), q_low) : tail * horner(z, kAtanFast);
    Num eighths = select(middle, 1.0f, num(x, 0.0f));
    Int minus = integer(bits(x), 0);
    minus = select(steep, integer(minus, INT32_MIN), minus);
    return {select(steep, 2.0f - eighths, eighths), flip_sign(q, minus), flip_sign(tail, minus)};
}

Num angle_of(Octant o, Tier tier) {
    if (tier == Tier::Precise) return plus_eighths(o.eighths, o.angle, o.low);
    return fma(o.eighths, 0.785398163f, o.angle + o.low);
}

Num atan_of(Num x, Tier tier) {
    // Beyond 2^100 the angle is pi/2 anyway, and infinity / infinity is kept out.
    Num a = at_most(num(x, 0x1p100f), abs(x));
    return flip_sign(angle_of(octant(num(x, 1.0f), a, tier), tier), sign_bit(x));
}

// A power of two by which sums, quotients and remainders of x and y stay normal; 0 if one is
// infinite.
Num common_scale(Num x, Num y) {
    Num larger = at_least(x, y);
    Num up = select(larger < 0x1p-60f, 0x1p60f, num(x, 1.0f));
    return select(larger == kInfinity, 0.0f, select(0x1p60f < larger, 0x1p-60f, up));
}

Num atan2_of(Num y, Num x, Tier tier) {
    Num ax = abs(x), ay = abs(y);
    Num scale = common_scale(ax, ay);
    Num limit = num(x, 0x1p100f);  // what 0 infinity becomes
    // The floor makes atan2(0, 0) = 0; the smallest scaled number is above it.
    Num sx = at_least(num(x, 0x1p-120f), at_most(ax * scale, limit));
    Num sy = at_most(ay * scale, limit);
    Octant o = octant(sx, sy, tier);
    Mask behind = x < 0.0f;
    Int mirror = select(behind, integer(bits(x), INT32_MIN), integer(bits(x), 0));
    o = {select(behind, 4.0f - o.eighths, o.eighths), flip_sign(o.angle, mirror),
         flip_sign(o.low, mirror)};
    Num value = flip_sign(angle_of(o, tier), sign_bit(y));
    return select(x == x, select(y == y, value, y), x);
}

// asin a = a + a z p(z) up to 1/2; beyond, pi/2 - 2 asin(sqrt((1 - a)/2)).
struct ArcSine {
    Mask small;  // a <= 1/2: the angle is asin a; else asin(sqrt((1 - a)/2))
    Num angle;
    Num low;
};
ArcSine arc_sine(Num a, Tier tier) {
    Mask small = a <= 0.5f;
    Num half = fma(a, -0.5f, 0.5f);  // exact where it is used
    Num root = sqrt(half);
    Num z = select(small, a * a, half);
    Num angle = select(small, a, root);
    if (tier == Tier::Fast) return {small, angle, angle * z * horner(z, kAsinFast)};
    // The root's own rounding: (half - root^2) / (2 root), 0 at 0.
    Num error = fma(-root, root, half) / at_least(root + root, num(a, 0x1p-60f));
    Num low = fma(angle * z, horner(z, kAsin), select(small, 0.0f, error));
    return {small, angle, low};
}

Num clamped_abs(Num x) {
    return at_most(num(x, 1.0f), abs(x));
}

Num asin_of(Num x, Tier tier) {
    ArcSine s = arc_sine(clamped_abs(x), tier);
    Num direct = s.angle + s.low;
    Num other = tier == Tier::Precise ? plus_eighths(num(x, 2.0f), -2.0f * s.angle, -2.0f * s.low)
                                      : fma(direct, -2.0f, kHalfPi[0]);
    return flip_sign(select(s.small, direct, other), sign_bit(x));
}

// acos x: pi/2 - asin x in the middle, 2 asin(sqrt((1 - x)/2)) and pi minus that at the ends.
Num acos_of(Num x, Tier tier) {
    ArcSine s = arc_sine(clamped_abs(x), tier);
    Int sign = sign_bit(x);
    Int opposite = sign ^ INT32_MIN;
    Num scale = select(s.small, 1.0f, num(x, 2.0f));
    Num eighths_behind = select(sign < 0, 4.0f, num(x, 0.0f));
    Num eighths = select(s.small, 2.0f, eighths_behind);
    Mask towards =
        s.small;  // in the middle the angle is taken off for x > 0, at the ends for x < 0
    Int flip = select(towards, opposite, sign);
    Num angle = flip_sign(s.angle * scale, flip);
    Num low = flip_sign(s.low * scale, flip);
    if (tier == Tier::Precise) return plus_eighths(eighths, angle, low);
    return fma(eighths, 0.785398163f, angle + low);
}

// 1 / sqrt x. With s = sqrt x rounded, r = 1 / s rounded, e = x - s^2, t = 1 - s r, the value is
// r (1 + t) (1 - e / (2 s^2)).
Num inversesqrt_precise(Num x) {
    Mask small = x < 0x1p-90f;  // e would be subnormal
    Num y = select(small, x * 0x1p64f, x);
    Num s = sqrt(y);
    Num r = 1.0f / s;
    Num e = fma(-s, s, y);
    Num t = fma(-s, r, 1.0f);
    Num value = fma(r, fma(e * r, r * -0.5f, t), r);
    value = select(small, value * 0x1p32f, value);
    // e is NaN at infinity
    return select(x == kInfinity, 0.0f, value);
}

Num inversesqrt_of(Num x, Tier tier) {
    Num value = tier == Tier::Precise ? inversesqrt_precise(x) : 1.0f / sqrt(x);
    return select(x <= 0.0f, 0.0f, value);
}

}  // namespace

Value asin(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "asin", tier, {x},
                       [&](std::span<const Num> p) { return asin_of(p[0], tier); });
}

Value acos(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "acos", tier, {x},
                       [&](std::span<const Num> p) { return acos_of(p[0], tier); });
}

Value atan(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "atan", tier, {x},
                       [&](std::span<const Num> p) { return atan_of(p[0], tier); });
}

Value atan2(Builder& b, Value y, Value x, Tier tier) {
    return call_tiered(b, "atan2", tier, {y, x},
                       [&](std::span<const Num> p) { return atan2_of(p[0], p[1], tier); });
}

Value inversesqrt(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "inversesqrt", tier, {x},
                       [&](std::span<const Num> p) { return inversesqrt_of(p[0], tier); });
}

}  // namespace kinora::jit::math
