// runtime/picture/compare/ulp.cpp: distances of floats by their bits and exponents.
#include "runtime/picture/compare/ulp.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace kinora {

namespace {

constexpr int kFractionBits = 23, kLeastExponent = -149;
constexpr double kBeyondFloats = 0x1.ffffffp127;  // halfway from the largest float to 2^128

// Floats in order: neighbours differ by 1, and both zeros are 0.
int64_t ordered_bits(float x) {
    int64_t bits = std::bit_cast<int32_t>(x);
    return bits < 0 ? int64_t(std::numeric_limits<int32_t>::min()) - bits : bits;
}

}  // namespace

double ulp_of(double exact) {
    if (exact == 0) return std::ldexp(1.0, kLeastExponent);
    return std::ldexp(1.0, std::max(std::ilogb(exact) - kFractionBits, kLeastExponent));
}

double ulps_between(float a, float b) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::infinity();
    return double(std::abs(ordered_bits(a) - ordered_bits(b)));
}

void FloatErrors::add(float got, double exact) {
    const bool is_nan = std::isnan(exact), is_inf = std::fabs(exact) >= kBeyondFloats;
    if (is_nan || is_inf || !std::isfinite(got)) {
        const bool same = is_nan   ? std::isnan(got)
                          : is_inf ? std::isinf(got) && std::signbit(got) == std::signbit(exact)
                                   : false;
        if (!same) ++special_;
        return;
    }
    const double error = std::fabs(double(got) - exact) / ulp_of(exact);
    ++count_;
    sum_ += error;
    max_ = std::max(max_, error);
    ++histogram_[size_t(std::ranges::lower_bound(kEdges, error) - kEdges.begin())];
}

}  // namespace kinora
