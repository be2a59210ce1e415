// runtime/picture/columns/kernels.h: places, directions and normals of hits in the space of
// shaders, sixteen at a time; one source, compiled per instruction set and chosen at run time. All
// give the bits that glm gives one by one.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr size_t kColumnPoints = 16;

// Columns of sixteen triples.
struct TripleColumns {
    const float* c[3];
};

// The normals of sixteen triangles' corners, four floats each as meshes have them, and where on the
// triangles.
struct alignas(64) CornerNormals {
    float corner[3][kColumnPoints][4];
    float u[kColumnPoints], v[kColumnPoints];  // barycentrics of corners 1 and 2
};

// Sixteen points on triangles: the barycentrics of corners 1 and 2, and what takes changes along
// the triangle's edges to changes along u and v (runtime/scene/description/affine_map.h).
struct alignas(64) OnTriangles {
    float u[kColumnPoints], v[kColumnPoints];
    float inv[2][2][kColumnPoints];
};

// A number at the three corners of sixteen triangles, and four numbers there.
struct alignas(64) CornerNumbers {
    float at[3][kColumnPoints];
};
struct alignas(64) CornerPlaces {
    float at[3][kColumnPoints][4];
};

// Sixteen numbers of each of two columns, and of three.
struct alignas(64) TwoRows {
    float at[2][kColumnPoints];
};
struct alignas(64) TripleRows {
    float at[3][kColumnPoints];
};

// By what sixteen hits are told apart.
struct HitNumbers {
    const uint32_t *pixel_x, *pixel_y, *sample, *layer;
};

// Matrices are nine floats, column by column. `to` may be `a`.
struct ColumnKernels {
    const char* name;
    // M a
    void (*turn)(const float* M, const TripleColumns& a, float* const to[3]);
    // M (a - b), b the same for all
    void (*turn_from)(const float* M, const TripleColumns& a, const float b[3], float* const to[3]);
    // M (a - b)
    void (*turn_between)(const float* M, const TripleColumns& a, const TripleColumns& b,
                         float* const to[3]);
    // The unit vectors of M times the mixtures of the corners' normals. Returns a bit for each
    // whose squared length is 0, infinite or NaN: its caller puts another in its place. `kinds`:
    // raytrace::kUnitNormals, kOneNormal or 0; M keeps angles.
    uint32_t (*mix_normals)(const float* M, const CornerNormals& at, float* const to[3],
                            uint32_t* kinds);
    // Finds `inv` and s, t from s, t at the corners. u, v are s, t where the triangle has an area
    // there, else the barycentrics, which `inv` then leaves as they are.
    void (*find_parameters)(OnTriangles& on, const CornerNumbers& s, const CornerNumbers& t,
                            TwoRows& st, TwoRows& uv);
    // The number between the corners, and its changes along u and v.
    void (*mix)(const OnTriangles& on, const CornerNumbers& x, float* value, TwoRows& along);
    // Changes along u and v of M times the place.
    void (*tangents)(const float* M, const OnTriangles& on, const CornerPlaces& places,
                     TripleRows& along_u, TripleRows& along_v);
    // The larger change of u, and of v, along two displacements on the surface: least squares on
    // the tangents, in double, since the fourth power of a length is no float in scenes of
    // kilometres or micrometres.
    void (*extents)(const TripleRows& dPdu, const TripleRows& dPdv, const TripleRows& dPdx,
                    const TripleRows& dPdy, TwoRows& extents);
    // The hits' random numbers in a frame (docs/decisions.md#random-numbers-without-state).
    void (*random)(const HitNumbers& hits, uint32_t depth, uint32_t frame_seed, uint32_t* to);
};
KINORA_KERNEL_TABLES(ColumnKernels, Columns);

// Those this CPU can run, and the widest of them.
const UsableKernels<ColumnKernels>& usable_column_kernels();
const ColumnKernels& column_kernels();

}  // namespace kinora
