// raytrace/hits.h: reading hits and writing rays, one at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/random/series.h"
#include "raytrace/sampling.h"
#include "raytrace/wavefront.h"

namespace kinora {

// The share of light that something of opacity Oi stops, as the camera has it; NaN stays NaN.
inline vec3 stopped_by(vec3 Oi) {
    for (int k = 0; k < 3; ++k) Oi[k] = std::clamp(Oi[k], 0.0f, 1.0f);
    return Oi;
}

inline vec3 triple(const float* const columns[3], size_t i) {
    return {columns[0][i], columns[1][i], columns[2][i]};
}
inline void set_triple(float* const columns[3], size_t i, vec3 value) {
    columns[0][i] = value.x;
    columns[1][i] = value.y;
    columns[2][i] = value.z;
}

// A hit's random number in a frame (docs/decisions.md#random-numbers-without-state).
inline uint32_t random_of(const raytrace::HitBatch& hits, size_t h, uint32_t frame_seed) {
    uint32_t pixel = raytrace::hash(hits.pixel_x[h], hits.pixel_y[h]) ^ raytrace::hash(frame_seed);
    uint32_t layer = hits.layer[h] % 64 + 64 * hits.depth + (hits.layer[h] / 64 << 16);
    return raytrace::hash(pixel, hits.sample[h], layer);
}

// What a hit draws from: the camera's hits in one pixel share a sequence, others have their own.
inline raytrace::SampleSeries series_of(const raytrace::HitBatch& hits, size_t h,
                                        uint32_t frame_seed) {
    if (hits.depth > 0) return {random_of(hits, h, frame_seed)};
    uint32_t pixel = raytrace::hash(hits.pixel_x[h], hits.pixel_y[h]) ^ raytrace::hash(frame_seed);
    return {raytrace::hash(pixel, 0x2c1b3c6du, hits.layer[h]), hits.sample[h], true};
}

// The way of a hit's ray since its last surface, or since it began; accel space.
inline vec3 segment(const raytrace::HitBatch& hits, size_t h) {
    float passed = hits.rays ? hits.rays->t_passed[hits.ray[h]] : 0.0f;
    if (passed == 0) return triple(hits.P, h) - triple(hits.org, h);
    return triple(hits.dir, h) * (hits.t[h] - passed);
}

// How far a ray from P may miss its end: origin, direction and the distance of a hit all round, 16
// steps of the largest.
inline float end_error(vec3 P, vec3 end) {
    float largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(P[k]), std::abs(end[k])});
    return largest * 16 * 0x1p-24f;
}

// Sets one ray of a packet or batch; both have the same columns.
template <class Rays>
void set_ray(Rays& rays, size_t i, vec3 org, vec3 dir, float tfar) {
    set_triple(rays.org, i, org);
    set_triple(rays.dir, i, dir);
    rays.tnear[i] = 0;
    rays.tfar[i] = tfar;
    rays.time[i] = 0;
}

}  // namespace kinora
