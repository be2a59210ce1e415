// runtime/picture/shading/lighting/lit_points.h: points where light is wanted.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raytrace/random/series.h"
#include "runtime/picture/lights/unseen_light.h"
#include "runtime/picture/shading/grid.h"

namespace kinora {

// Where light is wanted: points in current space, and in accel space with their error bounds.
struct LightPoints {
    size_t count = 0;
    const float* P[3];
    const float* N[3];
    const float* accel[3];
    const float* error[3];
    const float* Ng[3];                 // accel space
    const uint32_t* normals = nullptr;  // Grid::normals of these points
    const float* rng = nullptr;
    const raytrace::SampleSeries* series = nullptr;  // where some light has samples
    const uint32_t* surface = nullptr;               // the surface that is lit, kNone: none
    const float* zeros = nullptr;                    // a row of them
    size_t first = 0;  // grid point of element 0: what record columns are relative to
    bool own = false;  // the grid's points themselves
};

// Their accounts of rays, where the grid's points have such.
std::span<PointRays> accounts_of(const Grid& grid, const LightPoints& at);

// The grid's points as its kernel looks for lights.
SeenPoints seen_points(const Grid& grid);

// The points of a call whose first arguments are P, on no surface.
LightPoints points_of(const Grid& grid, const jit::ServiceCall& call);

// Whether such a call asks at these points of its grid.
bool asks_at(const LightPoints& points, const jit::ServiceCall& call);
// A part of them, from the first lane of a call on.
LightPoints part_of(const LightPoints& points, const jit::ServiceCall& call);

}  // namespace kinora
