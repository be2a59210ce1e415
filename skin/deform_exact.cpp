// skin/deform_exact.cpp: a normal in double, for numbers that leave float's safe range.
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/base/math.h"
#include "skin/deform_p.h"
#include "skin/influences_p.h"

namespace kinora::skin {

void exact_normal(const float* palette, const float* weights, const uint32_t* offsets,
                  uint32_t rounds, uint32_t vertex, const float* rest, float* normal) {
    dvec3 c[3] = {dvec3(0), dvec3(0), dvec3(0)};
    for (uint32_t r = 0; r < rounds; ++r) {
        const uint32_t entry = entry_of(rounds, r, vertex);
        const float* m = palette + offsets[entry];
        double w = weights[entry];
        if (w == 0) continue;  // padding
        for (int i = 0; i < 3; ++i) c[i] += w * dvec3(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    }
    dvec3 k0 = cross(c[1], c[2]);
    dvec3 n = k0 * double(rest[0]) + cross(c[2], c[0]) * double(rest[1]) +
              cross(c[0], c[1]) * double(rest[2]);
    double length = std::sqrt(dot(n, n));
    double scale =
        std::isfinite(length) && length > 0 ? std::copysign(1 / length, dot(k0, c[0])) : 0;
    for (int i = 0; i < 3; ++i) normal[i] = scale == 0 ? 0 : static_cast<float>(n[i] * scale);
    normal[3] = 0;
}

}  // namespace kinora::skin
