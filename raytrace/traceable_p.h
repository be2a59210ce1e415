// raytrace/traceable_p.h: which triangles and instances Embree may see. Debian's build aborts where
// two of the boxes that it joins are one and the same point, and on trees of such boxes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/placement_p.h"

namespace kinora::raytrace {

// True if the corners are finite, not too large for Embree, and do not all lie in one point. What
// this leaves out is never hit. Embree sees the vertices times `scale` (scale_p.h).
bool is_traceable(const vec4& a, const vec4& b, const vec4& c, float scale);

// For a mesh that is looked at again and again: an edge of each triangle with an even number that
// the next triangle has too, so that one look answers for both. Where they share none the edge has
// one vertex twice. Empty where few triangles follow a neighbour.
std::vector<uint32_t> shared_edges(std::span<const uint32_t> triangles);

// The triangles, with kNone for the corners of those that are not traceable: Embree skips a
// triangle whose corners it does not have, and the others keep their numbers. Empty if all are
// traceable, nearly always so: nothing is allocated then. `edges`: shared_edges() or none.
std::vector<uint32_t> without_untraceable(std::span<const vec4> positions,
                                          std::span<const uint32_t> triangles, float scale,
                                          std::span<const uint32_t> edges = {});
// Whether one is left of what without_untraceable() returned.
bool any_traceable(std::span<const uint32_t> triangles);

// Whether a box has one; not if low is above high.
bool has_extent(vec3 low, vec3 high);
// The box is of Embree's space of the mesh. False where float rounding may make a point of it as
// placed: the instance is then far smaller than the step between floats at its place.
bool surely_has_extent(const Placement& placement, vec3 low, vec3 high);

}  // namespace kinora::raytrace
