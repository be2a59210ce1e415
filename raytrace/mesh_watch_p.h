// raytrace/mesh_watch_p.h: cheap looks at a whole mesh: is it sound, how far has it stretched?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::raytrace {

inline constexpr float kLargest = 1.8e18f;  // Embree drops what is larger (its FLT_LARGE)

// Number of indices that name no vertex.
uint32_t count_bad_indices(size_t vertices, std::span<const uint32_t> triangles);

struct BoxAreas {
    double sum = 0;              // of half the areas of the triangles' boxes, bad ones left out
    uint32_t bad_triangles = 0;  // not finite, or with a coordinate beyond `largest`
};
// Looks at every n-th triangle of large meshes (the same ones each time, so ratios are true to a
// few per cent). The sum's order does not depend on threads. `partial` is memory to reuse.
BoxAreas box_areas(std::span<const vec4> positions, std::span<const uint32_t> triangles,
                   float largest, std::vector<BoxAreas>& partial);

}  // namespace kinora::raytrace
