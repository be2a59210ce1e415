// runtime/scene/images/latlong/kernels.h: directions to places of a latitude-longitude map and
// back, sixteen at a time. All instruction sets give the same bits: only what IEEE 754 rounds
// exactly is used, in one order, and nothing is contracted.
//
// Directions are in the map's own space: y is up, the picture's middle is along +z, and +x lies a
// quarter of its width left of that.
#pragma once

#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr int kLatlongLanes = 16;

// Where sixteen directions meet a map. Lanes whose direction is 0, infinite or no number are not
// usable, and the rest of their numbers means nothing.
struct alignas(64) LatlongPlaces {
    float s[kLatlongLanes], t[kLatlongLanes];    // t = 0: the bottom row
    float around[kLatlongLanes];                 // cosine of the latitude
    float ds[kLatlongLanes], dt[kLatlongLanes];  // how wide a footprint is, in parts of the map
    uint32_t usable[kLatlongLanes];              // 0 or 1
};

struct LatlongKernels {
    const char* name;
    // Of three rows of sixteen: x, y and z of directions of any length. Leaves ds and dt alone.
    void (*places)(const float* directions, LatlongPlaces& to);
    // Of nine such rows: the directions and their changes along two axes of a footprint.
    void (*footprints)(const float* directions, LatlongPlaces& to);
    // Directions of length 1, three rows of sixteen, and the cosines of their latitudes; s from the
    // picture's left, v from its top, both in [0, 1].
    void (*directions)(const double* s, const double* v, float* directions, float* around);
};
KINORA_KERNEL_TABLES(LatlongKernels, Latlong);

// Those this CPU can run, and the widest of them.
const UsableKernels<LatlongKernels>& usable_latlong_kernels();
const LatlongKernels& latlong_kernels();

}  // namespace kinora
