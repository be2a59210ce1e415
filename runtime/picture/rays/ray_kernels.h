// runtime/picture/rays/ray_kernels.h: the rays of sixteen lanes of a kernel, sixteen at a time. All
// instruction sets give the same bits: only what IEEE 754 rounds exactly is used, in one order, and
// nothing is contracted.
#pragma once

#include <cstdint>

#include "runtime/base/kernel_table.h"
#include "runtime/picture/rays/cone.h"

namespace kinora {

inline constexpr int kSixteen = 16;

// What a ray takes from its lane as it is, floats and integers alike: columns of a batch of rays.
inline constexpr int kCarried = 15;

// Of sixteen lanes: where their rays leave and whither.
struct alignas(64) RayLanes {
    float axis[3][kSixteen];  // a cone's, of any length; the direction of a ray without a cone
    float cosine[kSixteen];   // of the angle between a cone's axis and side
    float x[3][kSixteen], y[3][kSixteen], z[3][kSixteen];  // a cone's axes, as Cone has them
    uint32_t straight[kSixteen];                           // 1: rays without a cone
    uint32_t seed[kSixteen];
    // The surface that rays leave: a point with the bound of its rounding error, the normal of
    // length 1; 0: on no surface that is known.
    float P[3][kSixteen], error[3][kSixteen], Ng[3][kSixteen];
    // The hit, where rays turn back or go through, and the ray that saw it.
    float in_Ng[3][kSixteen], in[3][kSixteen], dDdx[3][kSixteen], dDdy[3][kSixteen];
    // There, the change a pixel of the unit normal on the side that the ray came from; 0: flat.
    float dNdx[3][kSixteen], dNdy[3][kSixteen];
    uint32_t carried[kCarried][kSixteen];
};

// Sixteen rays: of which lanes, and their numbers there.
struct alignas(64) RaySamples {
    uint32_t lane[kSixteen], number[kSixteen];
};

struct alignas(64) SixteenRays {
    float dir[3][kSixteen];
    float org[3][kSixteen];
    float dDdx[3][kSixteen], dDdy[3][kSixteen];
    uint32_t path[kSixteen];  // a hash of seed and number
    uint32_t carried[kCarried][kSixteen];
};

// What is to be made of the samples.
struct RayWants {
    bool cones;      // some lane has one
    bool by_cosine;  // denser along the axis: all cones
    bool spreads;    // dDdx and dDdy
};

struct RayKernels {
    const char* name;
    // Samples first, first + 1, ... of a cone.
    void (*directions)(const Cone& cone, uint32_t first, uint32_t seed, float (&dir)[3][kSixteen]);
    // Finds x, y and z from the lanes' axes.
    void (*aim)(RayLanes& lanes);
    // Lanes whose P, error and Ng are those of hits keep them where the hit is at `at`, in the
    // space that M (nine floats, column by column) leads to from `eye`; the others get `at` in the
    // hits' space and no surface.
    void (*start)(const float* M, const float eye[3], const float at[3][kSixteen], RayLanes& lanes);
    // Where the samples' rays leave (Pharr, Jakob, Humphreys, Physically Based Rendering, 6.8.6),
    // and how they spread (Igehy, Tracing ray differentials, 1999): as the ray that saw the hit,
    // mirrored, with what the curvature of the mirror adds, or turned.
    void (*shoot)(const RayLanes& lanes, const RaySamples& samples, const RayWants& wants,
                  SixteenRays& rays);
};
KINORA_KERNEL_TABLES(RayKernels, Rays);

// Those this CPU can run, and the widest of them.
const UsableKernels<RayKernels>& usable_ray_kernels();
const RayKernels& ray_kernels();

}  // namespace kinora
