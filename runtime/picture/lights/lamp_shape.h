// runtime/picture/lights/lamp_shape.h: what the triangles of a mesh that shines are as a whole.
#pragma once

#include <span>

#include "runtime/base/math.h"
#include "runtime/picture/lights/angle_kernels.h"

namespace kinora {

// In the space of the triangles. All of them lie within the shape.
struct LampShape {
    enum class Kind { Other, Rectangle, Sphere } kind = Kind::Other;
    // Of a rectangle: one corner, unit vectors along the sides from there and their normal.
    dvec3 corner{0.0}, axis[3] = {};
    double side[2] = {};
    // Of a sphere: the corners lie on it, and all triangles outside that of the inner radius.
    dvec3 center{0.0};
    double radius = 0, inner = 0;
};

// `corners`: three for each triangle. Triangles without area do not count. A rectangle and a sphere
// are recognised within 1e-5 of their size, and within the rounding of coordinates to float.
//   Rectangle: a plane one that the triangles fill once, whatever their number.
//   Sphere: the corners lie on it, and the triangles have at least 0.7 of its area.
LampShape find_lamp_shape(std::span<const dvec3> corners);

// The triangles of a rectangle, which have these numbers; none where there are more than it holds.
PlaneFacets facets_of(const LampShape& rectangle, std::span<const dvec3> corners,
                      std::span<const uint32_t> numbers);

}  // namespace kinora
