// runtime/scene/medium.h: what a ray runs through: the volumes it has entered, innermost first,
// packed into one word of the ray (RayBatch::medium).
//
// A volume is known by its number, ShaderInstance::volume, from 1; 0 is the atmosphere. Entering a
// fourth object inside three forgets the outermost.
#pragma once

#include <cstdint>

namespace kinora {

inline constexpr int kMediumBits = 10;
inline constexpr uint32_t kMaxVolumes = (1u << kMediumBits) - 1;
inline constexpr int kMediumDepth = 3;

constexpr uint32_t innermost(uint32_t medium) {
    return medium & kMaxVolumes;
}

constexpr uint32_t enter_volume(uint32_t medium, uint32_t volume) {
    constexpr uint32_t kAll = (1u << (kMediumBits * kMediumDepth)) - 1;
    return ((medium << kMediumBits) | volume) & kAll;
}

// Takes the volume out of the medium, wherever it stands (objects may overlap); a volume that was
// never entered changes nothing: the ray began inside.
constexpr uint32_t leave_volume(uint32_t medium, uint32_t volume) {
    for (int depth = 0; depth < kMediumDepth; ++depth) {
        int shift = kMediumBits * depth;
        if ((medium >> shift & kMaxVolumes) != volume) continue;
        uint32_t inner = medium & ((1u << shift) - 1);
        return (medium >> (shift + kMediumBits)) << shift | inner;
    }
    return medium;
}

}  // namespace kinora
