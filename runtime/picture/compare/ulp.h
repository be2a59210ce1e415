// runtime/picture/compare/ulp.h: how far floats are from each other and from exact values, in units
// of the last place.
#pragma once

#include <array>
#include <cstddef>

namespace kinora {

// The distance of the floats around `exact`; of those below the smallest normal one, 2^-149.
double ulp_of(double exact);

// How many floats lie between two numbers; -0 and 0 are one. Infinite if one alone is a NaN.
double ulps_between(float a, float b);

// How far many floats are from exact values.
class FloatErrors {
  public:
    // The bins of the histogram hold errors up to these; the last holds the rest.
    static constexpr std::array<double, 7> kEdges = {0, 0.5, 1, 2, 4, 16, 256};

    void add(float got, double exact);

    size_t count() const { return count_; }  // of values that are finite where they should be
    double max() const { return max_; }
    double mean() const { return count_ ? sum_ / double(count_) : 0; }
    size_t special() const { return special_; }  // NaN or infinity on one side alone
    const std::array<size_t, kEdges.size() + 1>& histogram() const { return histogram_; }

  private:
    size_t count_ = 0, special_ = 0;
    double max_ = 0, sum_ = 0;
    std::array<size_t, kEdges.size() + 1> histogram_{};
};

}  // namespace kinora
