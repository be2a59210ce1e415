// runtime/programs/shade/ulp_errors.cpp: errors in units of the last place, counted.
#include "runtime/programs/shade/ulp_errors.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

constexpr int kFractionBits = 23, kLeastExponent = -149;
constexpr double kBeyondFloats = 0x1.ffffffp127;  // halfway from the largest float to 2^128

}  // namespace

double ulp_of(double exact) {
    if (exact == 0) return std::ldexp(1.0, kLeastExponent);
    return std::ldexp(1.0, std::max(std::ilogb(exact) - kFractionBits, kLeastExponent));
}

void OutputErrors::add(float got, double exact) {
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
