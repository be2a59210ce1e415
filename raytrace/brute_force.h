// raytrace/brute_force.h: the reference for rays: every triangle, in double. For tests.
#pragma once

#include <span>

#include "raytrace/accel.h"

namespace kinora::raytrace {

struct ReferenceRay {
    dvec3 org, dir;
    double tnear = 0, tfar = 1e300;
    uint32_t mask = kMaskAll;
};

struct ReferenceHit {
    uint32_t geometry = kNone;  // Geometry::id
    uint32_t instance = kNone;
    uint32_t primitive = kNone;
    double u = 0, v = 0, t = 0;
    dvec3 Ng{0.0};  // not normalised, sides as HitPacket16::Ng
};

// The nearest hit, of equal ones the lowest (row, primitive). Moeller, Trumbore: Fast, minimum
// storage ray-triangle intersection, 1997. Triangles without area are never hit.
ReferenceHit brute_force(std::span<const Geometry> geometry, const ReferenceRay& ray);

}  // namespace kinora::raytrace
