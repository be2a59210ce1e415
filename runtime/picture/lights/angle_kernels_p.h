// runtime/picture/lights/angle_kernels_p.h: the kernels of angle_kernels.h in plain C++, loops over
// sixteen that the compiler makes vectors of. Every operation rounds once, so all widths give the
// same bits.
//
// Rectangles: C. Urena, M. Fajardo, A. King, An Area-Preserving Parametrization for Spherical
// Rectangles, 2013.
#pragma once

#include "runtime/base/kernel_math.h"
#include "runtime/picture/lights/angle_kernels.h"
#include "runtime/picture/lights/angles.h"

namespace kinora {
namespace {

#define KINORA_LANES _Pragma("GCC ivdep") for (size_t i = 0; i < kAngleLanes; ++i)

constexpr double kWholeTurn = 6.283185307179586477;

__attribute__((always_inline)) inline double held(double x, double low, double high) {
    const double above = x < low ? low : x;
    return above > high ? high : above;
}

// The inner angle at a corner, where the planes through two sides meet, whose normals are `z` along
// z and `across` along the sides' axes.
__attribute__((always_inline)) inline double corner_angle(double z0, double across0, double z1,
                                                          double across1) {
    const double sine2 = across0 * across0 + z0 * z0 * (across1 * across1);
    return angle_of(__builtin_sqrt(sine2), -z0 * z1);
}

// The angles come from sines and cosines together, so that small ones keep their digits. The
// normals look outwards, as -y, x, y and -x do.
void see_rectangles(RectangleLanes& seen) {
    KINORA_LANES {
        const double z = seen.z[i], x0 = seen.x[0][i], x1 = seen.x[1][i], y0 = seen.y[0][i],
                     y1 = seen.y[1][i];
        const double to_y0 = __builtin_sqrt(y0 * y0 + z * z),
                     to_y1 = __builtin_sqrt(y1 * y1 + z * z),
                     to_x0 = __builtin_sqrt(x0 * x0 + z * z),
                     to_x1 = __builtin_sqrt(x1 * x1 + z * z);
        const double below = -(y0 / to_y0), above = y1 / to_y1, left = -(x0 / to_x0),
                     right = x1 / to_x1;
        const double at_y0 = z / to_y0, at_y1 = z / to_y1, at_x0 = z / to_x0, at_x1 = z / to_x1;
        const double start = kWholeTurn - corner_angle(above, at_y1, left, at_x0) -
                             corner_angle(left, at_x0, below, at_y0);
        seen.first[i] = below;
        seen.last[i] = above;
        seen.start[i] = start;
        seen.angle[i] = corner_angle(below, at_y0, right, at_x1) +
                        corner_angle(right, at_x1, above, at_y1) - start;
    }
}

// The part u of the solid angle lies before the plane x; along the line there, heights on the
// sphere are even.
void to_rectangles(const RectangleLanes& seen, const AngleLanes& u, const AngleLanes& v,
                   AngleLanes& x, AngleLanes& y) {
    KINORA_LANES {
        const double part = u[i] * seen.angle[i] + seen.start[i];
        double cosine, sine;
        turn_to(part / kWholeTurn, cosine, sine);
        const double f = (cosine * seen.first[i] - seen.last[i]) / sine;
        const double out = 1 / __builtin_sqrt(f * f + seen.first[i] * seen.first[i]);
        const double c = out < 1 ? out : 1.0, left2 = 1 - c * c;
        const double reach = left2 > 0 ? c * seen.z[i] / __builtin_sqrt(left2) : 1e300;
        x[i] = held(f > 0 ? reach : -reach, seen.x[0][i], seen.x[1][i]);
    }
    KINORA_LANES {
        const double line2 = x[i] * x[i] + seen.z[i] * seen.z[i], y0 = seen.y[0][i],
                     y1 = seen.y[1][i];
        const double low = y0 / __builtin_sqrt(line2 + y0 * y0),
                     high = y1 / __builtin_sqrt(line2 + y1 * y1);
        const double height = low + v[i] * (high - low), rest2 = 1 - height * height;
        const double at = rest2 > 0 ? height * __builtin_sqrt(line2 / rest2) : y1;
        y[i] = held(at, y0, y1) - y0;
    }
    KINORA_LANES x[i] -= seen.x[0][i];
}

void on_facets(const PlaneFacets& facets, const AngleLanes& x, const AngleLanes& y,
               uint32_t (&triangle)[kAngleLanes], float (&u)[kAngleLanes],
               float (&v)[kAngleLanes]) {
    double best[kAngleLanes], best_u[kAngleLanes], best_v[kAngleLanes];
    uint64_t at[kAngleLanes];  // as wide as what decides it
    KINORA_LANES {
        best[i] = -__builtin_inf();
        best_u[i] = best_v[i] = 0;
        at[i] = 0;
    }
    for (size_t f = 0; f < facets.count; ++f) {
        const double *U = facets.u[f], *V = facets.v[f];
        const double u0 = U[0], u1 = U[1], u2 = U[2], v0 = V[0], v1 = V[1], v2 = V[2];
        const uint64_t number = facets.triangle[f];
        KINORA_LANES {
            const double a = u0 * x[i] + u1 * y[i] + u2, b = v0 * x[i] + v1 * y[i] + v2;
            const double c = 1 - a - b, ab = a < b ? a : b, least = c < ab ? c : ab;
            const bool inner = least > best[i];
            best[i] = inner ? least : best[i];
            best_u[i] = inner ? a : best_u[i];
            best_v[i] = inner ? b : best_v[i];
            at[i] = inner ? number : at[i];
        }
    }
    KINORA_LANES {
        const double a = held(best_u[i], 0, 1);
        u[i] = float(a);
        v[i] = float(held(best_v[i], 0, 1 - a));
        triangle[i] = uint32_t(at[i]);
    }
}

void to_spheres(const SphereLanes& seen, const AngleLanes& u, const AngleLanes& v,
                AngleLanes (&direction)[3]) {
    double along[3][kAngleLanes];
    KINORA_LANES {
        const double down = u[i] * seen.opening[i], out = __builtin_sqrt(down * (2 - down));
        double x, y;
        turn_to(v[i], x, y);
        along[0][i] = out * x;
        along[1][i] = out * y;
        along[2][i] = 1 - down;
    }
    for (size_t k = 0; k < 3; ++k)
        KINORA_LANES direction[k][i] = along[0][i] * seen.axis[0][k][i] +
                                       along[1][i] * seen.axis[1][k][i] +
                                       along[2][i] * seen.axis[2][k][i];
}

}  // namespace

extern const AngleKernels KINORA_KERNEL_TABLE(Angles) = {KINORA_INSTRUCTION_SET, see_rectangles,
                                                         to_rectangles, on_facets, to_spheres};

}  // namespace kinora
