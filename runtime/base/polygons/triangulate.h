// runtime/base/polygons/triangulate.h: polygons with holes become triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

struct Triangulation {
    bool self_intersecting = false;  // no clean cut exists; triangles cover it somehow
    uint32_t lost_holes = 0;         // holes that reach no outer edge
};

// Appends triples of corner numbers, wound like the outline. Corners are numbered through
// `corners`: the outline's first, then each hole's. loops[i] is the number of corners of loop i,
// loops[0] the outline. Loops shorter than 3 are ignored. Work is bounded: a polygon past the
// budget is cut as a fan from where it stands.
Triangulation triangulate(std::span<const dvec3> corners, std::span<const uint32_t> loops,
                          std::vector<uint32_t>& triangles);

}  // namespace kinora
