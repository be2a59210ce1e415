// jit/math/log.cpp: log, log2 and pow.
#include <cmath>
#include <limits>

#include "jit/math/coefficients_p.h"
#include "jit/math/exp_p.h"

namespace kinora::jit::math {
namespace {

constexpr float kSmallestNormal = std::numeric_limits<float>::min();
constexpr int32_t kSqrtHalfBits = 0x3f3504f3;

// x = m 2^e, sqrt(1/2) <= m < sqrt 2, for a positive normal x.
struct Split {
    Num m;
    Num e;
};
Split split(Num x) {
    Int pattern = bits(x) - kSqrtHalfBits;
    return {from_bits((pattern & 0x7fffff) + kSqrtHalfBits),
            to_float(shift_right_signed(pattern, 23))};
}

// The formula's value for finite x; infinity and NaN are their own logarithms.
Num finite_or_same(Num x, Num value) {
    return select(x < kInfinity, value, x);
}

// e + h + low where e is 0 or |e| >= |h|.
Num sum_from_largest(Num e, Num h, Num low) {
    Num sum = e + h;
    return sum + (((e - sum) + h) + low);
}

Num log_precise(Num x) {
    auto [m, e] = split(at_least(x, num(x, kSmallestNormal)));
    Num f = m - 1.0f;
    Num z = f * f;
    Num tail = fma(z * f, horner(f, kLog), -0.5f * z);
    Num value = sum_from_largest(e * kLn2Short[0], f, fma(e, kLn2Short[1], tail));
    return finite_or_same(x, value);
}

Num log_fast(Num x) {
    auto [m, e] = split(at_least(x, num(x, kSmallestNormal)));
    Num f = m - 1.0f;
    Num one = fma(f * f, horner(f, kLogFast), f);
    return finite_or_same(x, fma(e, kLn2[0], one));
}

Num log2_precise(Num x) {
    auto [m, e] = split(at_least(x, num(x, kSmallestNormal)));
    Num f = m - 1.0f;
    Num z = f * f;
    Num tail = fma(z * f, horner(f, kLog), -0.5f * z);
    Num h = f * kLog2e[0];
    Num z_low = fma(f, f, -z);
    Num h_low = fma(z_low, -0.5f * kLog2e[0], fma(f, kLog2e[1], fma(f, kLog2e[0], -h)));
    Num low = fma(tail, kLog2e[0], h_low);
    return finite_or_same(x, sum_from_largest(e, h, low));
}

Num log2_fast_of(Split x) {
    Num f = x.m - 1.0f;
    return fma(f, horner(f, kLog2Fast), x.e);
}

Num log2_fast(Num x) {
    return finite_or_same(x, log2_fast_of(split(at_least(x, num(x, kSmallestNormal)))));
}

struct Sum {
    Num hi, lo;
};

// log2 x to about 2^-38 of its value, for finite x > 0, subnormals too.
// log2 m = 2/ln 2 (s + s^3/3 + s^5 p(s^2)), s = (m - 1)/(m + 1), the first two terms in pairs.
Sum log2_pair(Num x) {
    Mask small = x < kSmallestNormal;
    auto [m, e0] = split(select(small, x * 0x1p24f, x));
    Num e = select(small, e0 - 24.0f, e0);
    Num f = m - 1.0f;
    Num g = m + 1.0f;
    Num g_low = m - (g - 1.0f);
    Num reciprocal = 1.0f / g;
    Num s = f * reciprocal;
    Num s_low = fma(-s, g_low, fma(-s, g, f)) * reciprocal;
    Num z = s * s;
    Num z_low = fma(s, s, -z) + (s + s) * s_low;
    Num t = z * horner(z, kLog2Pow);
    Num u = kTwoThirdsLog2e[0] + t;
    Num u_low = ((kTwoThirdsLog2e[0] - u) + t) + kTwoThirdsLog2e[1];
    Num w = z * u;
    Num w_low = fma(z, u, -w) + fma(z, u_low, z_low * u);
    Num v = kTwoLog2e[0] + w;
    Num v_low = ((kTwoLog2e[0] - v) + w) + (w_low + kTwoLog2e[1]);
    Num l = s * v;
    Num l_low = fma(s, v, -l) + fma(s, v_low, s_low * v);
    Num hi = e + l;
    return {hi, ((e - hi) + l) + l_low};
}

// y saturated, so that y log2 x is free of infinity - infinity, and far outside the range all the
// same.
Num bounded(Num y) {
    return at_most(num(y, 0x1p40f), at_least(num(y, -0x1p40f), y));
}

// What the formula cannot know: pow(x, 0) = 1 for every x, pow(0, y) = 0 (NaN for NaN); y bounded.
// y * 0 is a constant wherever y is one.
Num pow_edges(Num x, Num y, Num value) {
    return select(y == 0.0f, 1.0f, select(x == 0.0f, abs(y * 0.0f), value));
}

Num pow_precise(Num x, Num y) {
    Num yb = bounded(y);
    Mask usual = x < kInfinity;
    Sum l = log2_pair(select(usual, x, 1.0f));
    Num l_hi = select(usual, l.hi, x);  // infinity and NaN go on
    Num p = yb * l_hi;
    Num p_low = fma(yb, l_hi, -p) + yb * l.lo;
    Num value = exp2_of_sum(p, select(abs(p) < 256.0f, p_low, 0.0f));
    return pow_edges(x, yb, value);
}

// x^n by squaring. Within 4 + 2|n log2 x| ULP up to n = 9 (tests/jit/math_test.cpp).
constexpr float kMostMultiplied = 9;
Num power(Num x, int n) {
    if (n == 1) return x;
    Num half = power(x, n / 2);
    return n % 2 != 0 ? half * half * x : half * half;
}

Num pow_fast(Num x, Num y) {
    Num l = finite_or_same(x, log2_fast_of(split(at_least(x, num(x, kSmallestNormal)))));
    Num yb = bounded(y);
    return pow_edges(x, yb, exp2_fast(yb * l));
}

}  // namespace

Value log(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "log", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? log_precise(p[0]) : log_fast(p[0]);
    });
}

Value log2(Builder& b, Value x, Tier tier) {
    return call_tiered(b, "log2", tier, {x}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? log2_precise(p[0]) : log2_fast(p[0]);
    });
}

Value pow(Builder& b, Value x, Value y, Tier tier) {
    float n;
    if (tier == Tier::Fast && b.constant_f(y, &n) && n >= 1 && n <= kMostMultiplied &&
        n == std::floor(n))
        return power({&b, x}, static_cast<int>(n)).v;
    return call_tiered(b, "pow", tier, {x, y}, [&](std::span<const Num> p) {
        return tier == Tier::Precise ? pow_precise(p[0], p[1]) : pow_fast(p[0], p[1]);
    });
}

}  // namespace kinora::jit::math
