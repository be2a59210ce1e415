// runtime/picture/lights/cone_samples.h: where light comes from that a part of the sky sends.
#pragma once

#include <cstdint>
#include <span>

#include "raytrace/random/series.h"
#include "runtime/base/arena.h"

namespace kinora {

// Of lit points: columns of `count` floats.
struct SkyCones {
    size_t count = 0;
    const float* axis[3];  // to the light, of any length, which directions keep
    const float* angle;    // radians between the axis and the side; 0 or NaN: the axis alone
    const raytrace::SampleSeries* series;
    uint32_t seed = 0;     // of the light
    uint32_t samples = 1;  // of a point
};

// Directions in the cones: sixteen samples at a time, of each a row a component.
class ConeSamples {
  public:
    static constexpr uint32_t kAtOnce = 16;

    // Rows have `padded` floats, copies of the last point behind it.
    ConeSamples(const SkyCones& cones, size_t padded, Arena& arena);
    // Samples first, first + 1, ..., first a multiple of 16: uniform in solid angle, a point's own
    // stratified sequence.
    void find(uint32_t first);
    float* row(size_t sample, size_t component) const { return rows_[sample][component]; }

  private:
    SkyCones cones_;
    size_t padded_;
    float* rows_[kAtOnce][3];
};

}  // namespace kinora
