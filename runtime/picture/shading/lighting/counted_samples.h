// runtime/picture/shading/lighting/counted_samples.h: which samples of a light count at lit points.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/picture/lights/light_samples.h"
#include "runtime/picture/shading/lighting/lit_points.h"

namespace kinora {

// Of the samples that a light with sample methods sent. Where more were sent than may count, those
// that do are evenly far apart, from a random one on: each sample is as likely as the others, so
// sums keep their mean.
class CountedSamples {
  public:
    // At most `most` at a point, 0: all. `light` tells apart what lights draw.
    CountedSamples(const LightAnswer& answer, const LightPoints& at, uint32_t most, uint32_t light,
                   Arena& arena);

    size_t most() const { return most_; }                   // at one point
    const float* counts() const { return counts_.data(); }  // by point
    // The k-th of the point; null where it has fewer.
    const LightSampleRows* find(size_t k, size_t point) const;

  private:
    const float* sent_;  // by point
    std::span<const LightSampleRows*> rows_;
    std::span<float> counts_, starts_;
    size_t most_;
};

}  // namespace kinora
