// runtime/rays/ray_kernels.h: sixteen rays from one point at a time. All instruction sets give the
// same bits: only what IEEE 754 rounds exactly is used, in one order, and nothing is contracted.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/rays/cone.h"

namespace kinora {

inline constexpr int kSixteen = 16;

struct alignas(64) SixteenRays {
    float dir[3][kSixteen];
    float org[3][kSixteen];
    float dDdx[3][kSixteen], dDdy[3][kSixteen];
};

// The surface that rays leave, and the ray that saw it.
struct RaySource {
    vec3 P, error;  // with the bound of its rounding error
    vec3 Ng;        // length 1; 0: on no surface that is known
    vec3 in_Ng;     // of the hit; rays turn back or go through there
    vec3 in;        // direction of the ray that saw it
    vec3 dDdx, dDdy;
};

struct RayKernels {
    const char* name;  // "portable", "avx2", "avx512"
    // Samples first, first + 1, ... of a cone.
    void (*directions)(const Cone& cone, uint32_t first, uint32_t seed, SixteenRays& rays);
    // Where rays of those directions leave the source (Pharr, Jakob, Humphreys, Physically Based
    // Rendering, 6.8.6), and how they spread: as the ray that saw it, mirrored or turned (Igehy,
    // Tracing ray differentials, 1999), without what the surface's curvature adds.
    void (*leave)(const RaySource& source, SixteenRays& rays);
};

// Of the best instruction set that this CPU has.
const RayKernels& ray_kernels();
// Of all that it has; for tests.
std::span<const RayKernels* const> all_ray_kernels();

}  // namespace kinora
