// raytrace/scale_p.h: the scale at which Embree works. Its tests of triangles multiply a distance
// by an area as floats, and denormals are flushed: triangles of 1e-14 units would never be hit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "raytrace/accel.h"

namespace kinora::raytrace {

// Twice the largest coordinate: about the size, since vertices lie about their space's zero.
double size_of(std::span<const vec4> positions);
// Of all rows as they stand.
double size_of(std::span<const Geometry> rows);

// The power of two that brings a size between `least` and `most`, or near: 1 where it is there, so
// that ordinary vertices are read in place. It changes no digit of a float. Small sizes come to
// 1..2. Large ones come to `most` and no further: one vertex far off may be all that is large.
float scale_within(double size, double least, double most);

// Of a scene. It may grow: a scale of nearly 0 is a customary way to hide.
inline float top_scale(double size) {
    return std::min(scale_within(size, 0x1p-10, 0x1p30), 0x1p30f);
}

// Of a mesh that is instanced in it: what an instance's matrix scales by stays within kLargestGain
// (placement.cpp), however a file divides sizes between vertices and nodes.
float local_scale(double scene_size, double mesh_size);

// What Embree sees of the rays; directions stay, so distances are scaled.
RayPacket16 scaled(const RayPacket16& rays, float scale);
// Distances of the lanes of `which` in the caller's units again.
void unscale(HitPacket16& hits, uint32_t which, float scale);

}  // namespace kinora::raytrace
