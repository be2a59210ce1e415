// runtime/picture/lights/cone_samples.cpp: samples of a part of the sky.
#include "runtime/picture/lights/cone_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/random/bits.h"
#include "runtime/picture/rays/ray_kernels.h"

namespace kinora {

static_assert(ConeSamples::kAtOnce == kSixteen);

ConeSamples::ConeSamples(const SkyCones& cones, size_t padded, Arena& arena)
    : cones_(cones), padded_(padded) {
    for (auto& sample : rows_)
        for (float*& row : sample) row = arena.allocate_span<float>(padded).data();
}

void ConeSamples::find(uint32_t first) {
    float dir[3][kSixteen];
    for (size_t i = 0; i < cones_.count; ++i) {
        const vec3 axis(cones_.axis[0][i], cones_.axis[1][i], cones_.axis[2][i]);
        const float length = glm::length(axis), angle = std::abs(cones_.angle[i]);
        const bool wide = length > 0 && angle > 0;
        if (wide) {
            const Cone cone(axis, std::min(angle, float(kPi)), false);
            const raytrace::SampleSeries series =
                raytrace::series_of(cones_.series[i], cones_.seed);
            ray_kernels().directions(cone, series.part * cones_.samples + first, series.seed, dir);
        }
        for (size_t s = 0; s < kAtOnce; ++s)
            for (int c = 0; c < 3; ++c) rows_[s][c][i] = wide ? dir[c][s] * length : axis[c];
    }
    for (auto& sample : rows_)
        for (float* row : sample)
            std::fill(row + cones_.count, row + padded_, row[cones_.count - 1]);
}

}  // namespace kinora
