// raytrace/points/points.h: points on triangles with their error bounds, and footprints of rays on
// them, sixteen at a time; one source, compiled per instruction set and chosen at run time.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora::raytrace {

inline constexpr size_t kPoints = 16;

// Sixteen triangles and where on them. Four floats a corner, as meshes have them.
struct alignas(64) TrianglePoints {
    float corner[3][kPoints][4];
    float u[kPoints], v[kPoints];  // barycentrics of corners 1 and 2
};

// What is there: the point, a bound of its rounding error, the cross product of two edges.
struct alignas(64) PointBlock {
    float P[3][kPoints], error[3][kPoints], N[3][kPoints];
};

// Columns of sixteen rays that met a surface.
struct FootprintRays {
    const float* dO[3];  // change of the origin, a pixel
    const float* dD[3];  // and of the direction
    const float* dir[3];
    const float* Ng[3];
    const float* t;
};

// Sixteen rays.
struct PacketRays {
    const float* org[3];
    const float* dir[3];
    const float* tnear;
    const float* tfar;
};

// Sixteen rays that leave surfaces for an end.
struct alignas(64) LeavingRays {
    float P[3][kPoints], error[3][kPoints];  // where, with a bound of its rounding error
    float Ng[3][kPoints];                    // length 1; 0: no surface is known
    float way[3][kPoints];                   // from P to the end
    float up[3][kPoints];        // from P to where the ray begins; 0: it leaves the surface itself
    float short_of[3][kPoints];  // added to the end
    uint32_t endless[kPoints];   // 1: the ray goes along `way`, without an end
};

// A column of four-byte numbers, and where those that are kept come to stand.
struct KeptColumn {
    const void* from;
    void* to;
};
inline constexpr size_t kMostKept = 32;  // columns

// What the normals of a triangle's corners say of the smooth surface that they describe: their
// lengths are within a thousandth of 1 and they lie near each other; or they are all the same.
inline constexpr uint32_t kUnitNormals = 1, kOneNormal = 2;

struct PointKernels {
    const char* name;
    // Of sixteen rows from `first` on those with a bit in `lanes`, one behind the other to the rows
    // from `at` on. Sixteen rows are read and sixteen written: what comes behind those that are
    // kept is any of them.
    void (*keep)(uint32_t lanes, const KeptColumn* columns, size_t count, size_t first, size_t at);
    // The rows with these sixteen numbers, none less than the one before. What may be read: blocks of sixteen rows
    // that hold one of them.
    void (*pick)(const uint32_t* rows, const KeptColumn* columns, size_t count);
    // error_scale: gamma(7) of Pharr, Jakob, Humphreys, 6.8.1. Returns a bit for each normal whose
    // squared length is not between least and most: its caller finds it with more care.
    uint32_t (*interpolate)(const TrianglePoints& at, float error_scale, float least, float most,
                            PointBlock& out);
    // Lengths of 1; 0 stays.
    void (*normalize)(PointBlock& block);
    // Whether in all rays origins are within +-far, squared lengths of directions from least to
    // most, and 0 <= tnear <= tfar, tnear finite. A NaN anywhere is false.
    bool (*sound)(const PacketRays& rays, float far, float least, float most);
    // Igehy, Tracing ray differentials, 1999, eq. 10-12: dP = dO + t dD + dt D, with dt such that
    // dP lies in the plane of Ng; t is from the ray's first origin.
    void (*footprint)(const FootprintRays& rays, float least_cosine, float* const dP[3]);
    // Origins as offset_ray_origin() gives them for P + up, and the directions from there to the
    // ends, which are at 1 of their lengths.
    void (*leave)(const LeavingRays& from, float* const org[3], float* const dir[3], float* tfar);
    // A bit for each light that the facet surely sees as the smooth surface does: the cosine
    // between Ng and the light is beyond +-least_cosine, and N, the unit vector of the mixture of
    // kUnitNormals, is clearly on the same side of both. Also where there is kOneNormal.
    uint32_t (*sees_light)(const LeavingRays& from, const float* const N[3],
                           const uint32_t* normals, float least_cosine);
};
KINORA_KERNEL_TABLES(PointKernels, Points);

// Those this CPU can run, and the widest of them.
const UsableKernels<PointKernels>& usable_point_kernels();
const PointKernels& point_kernels();

}  // namespace kinora::raytrace
