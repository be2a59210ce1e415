// runtime/columns/kernels.h: places, directions and normals of hits in the space of shaders,
// sixteen at a time; one source, compiled per instruction set and chosen at run time. All give the
// bits that glm gives one by one.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

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
    // whose squared length is 0, infinite or NaN: its caller puts another in its place.
    uint32_t (*mix_normals)(const float* M, const CornerNormals& at, float* const to[3]);
};
extern const ColumnKernels kPortableColumns;
extern const ColumnKernels kAvx2Columns;
extern const ColumnKernels kAvx512Columns;

// Those this CPU can run, the widest first.
struct UsableColumnKernels {
    const ColumnKernels* kernels[3];
    size_t count;
};
const UsableColumnKernels& usable_column_kernels();
const ColumnKernels& column_kernels();

}  // namespace kinora
