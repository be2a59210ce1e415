// runtime/picture/lights/angle_kernels.h: samples that are even in the solid angles of lamps, of
// sixteen points at once; one source, compiled per instruction set and chosen at run time. All give
// the same bits.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr size_t kAngleLanes = 16;
using AngleLanes = double[kAngleLanes];

// Rectangles as points see them, by axes along their sides (solid_angle.cpp).
struct alignas(64) RectangleLanes {
    AngleLanes x[2], y[2];   // where the sides are
    AngleLanes z;            // distance of the plane, above 0
    AngleLanes first, last;  // z of the normals of the planes through the point and the sides y
    AngleLanes angle;        // the solid angle
    AngleLanes start;        // offset from a part of it to the turn of a sample's plane
};

// Spheres as points see them.
struct alignas(64) SphereLanes {
    AngleLanes axis[3][3];  // orthonormal, the last to the center
    AngleLanes opening;     // 1 - the cosine of the angle between axis and side
};

// The triangles of a plane rectangle, by places from its corner: u of a place is
// u[0] x + u[1] y + u[2], and v likewise.
struct PlaneFacets {
    static constexpr size_t kMost = 8;
    size_t count = 0;
    double u[kMost][3], v[kMost][3];
    uint32_t triangle[kMost];
};

struct AngleKernels {
    const char* name;
    // Finds first, last, angle and start of rectangles from the rest.
    void (*see_rectangles)(RectangleLanes& seen);
    // Places on rectangles, from the corner that x[0] and y[0] are, for u and v in [0, 1).
    void (*to_rectangles)(const RectangleLanes& seen, const AngleLanes& u, const AngleLanes& v,
                          AngleLanes& x, AngleLanes& y);
    // The triangle at each place, or the nearest, and the place in it: u, v and 1 - u - v are not
    // below 0.
    void (*on_facets)(const PlaneFacets& facets, const AngleLanes& x, const AngleLanes& y,
                      uint32_t (&triangle)[kAngleLanes], float (&u)[kAngleLanes],
                      float (&v)[kAngleLanes]);
    // Directions of length 1 to spheres.
    void (*to_spheres)(const SphereLanes& seen, const AngleLanes& u, const AngleLanes& v,
                       AngleLanes (&direction)[3]);
};
KINORA_KERNEL_TABLES(AngleKernels, Angles);

// Those this CPU can run, and the widest of them.
const UsableKernels<AngleKernels>& usable_angle_kernels();
const AngleKernels& angle_kernels();

}  // namespace kinora
