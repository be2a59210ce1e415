// runtime/frame/quality.h: the speed/accuracy trade: named rows of knob settings.
#pragma once

#include <span>
#include <string_view>

#include "jit/math/math.h"
#include "runtime/scene/scene.h"

namespace kinora {

// One row of --quality; an option given by itself wins over its row.
struct Quality {
    const char* name;
    int samples_per_pixel;
    jit::math::Tier math;           // transcendental functions: 4 or 1 ULP
    bool robust;                    // Embree's watertight traversal
    DisplacementMode displacement;  // move vertices, or only bend N
    double dice;                    // edges of displaced surfaces, pixels
    bool always_rebuild;            // a fresh BVH each frame instead of a refitted one
    int ray_depth;                  // SceneOptions::ray_depth, diffuse_depth, split
    int diffuse_depth;
    int split;
};

std::span<const Quality> qualities();
const Quality* find_quality(std::string_view name);  // null: no such row
inline constexpr std::string_view kDefaultQuality = "final";

}  // namespace kinora
