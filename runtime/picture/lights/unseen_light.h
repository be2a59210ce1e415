// runtime/picture/lights/unseen_light.h: light that needs no shadow ray, since nothing sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/base/arena.h"

namespace kinora {

struct LightSamples;

// What one statement of a light sends to each of a number of points.
struct SentLight {
    bool solar = false;
    bool casts = false;          // shadows take it away
    const float* L[3];           // to the light
    const float* lit = nullptr;  // an int; null: everywhere
    float* Cl[3];
    const LightSamples* samples = nullptr;  // that send it, of a light on geometry
};

// Points of one surface kernel, in current space; null columns are not known.
struct SeenPoints {
    size_t count = 0;
    uint8_t sides = 0;  // rsl::LitSide: what the kernel looks about
    const float *N[3], *Ng[3], *I[3];
};

// The direction about which the kernel looks at each point, of length 1; 0 where that is not one.
void find_looks(const SeenPoints& points, Arena& arena, float* const looks[3]);

// Makes Cl 0 where the light comes from behind all that the kernel looks about. Pictures keep
// their bits.
void drop_behind(const SeenPoints& points, Arena& arena, std::span<const SentLight> lights);

// Makes Cl 0 of the weakest lights at each point, as if they were shadowed: together they are at
// most `share` of what all lights send there, before shadows. Of a light's colour the largest
// component counts.
void drop_weak(float share, size_t points, Arena& arena, std::span<const SentLight> lights);

}  // namespace kinora
