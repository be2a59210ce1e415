// runtime/picture/rays/ray_kernels_p.h: the kernels, loops over sixteen that the compiler makes
// vectors of. Included by one file for each instruction set; all names are the file's own.
#pragma once

#include "raytrace/random/bits.h"
#include "runtime/base/kernel_math.h"
#include "runtime/picture/rays/ray_kernels.h"

namespace kinora {
namespace {

// No function of a library is called here: compiled for this instruction set, it could be the one
// that the linker takes for all of the program.
#define KINORA_SIXTEEN _Pragma("GCC ivdep") for (int i = 0; i < kSixteen; ++i)

using Row = float[kSixteen];
using Rows = float[3][kSixteen];

// Along the axes of a cone. By cosine: a disc's uniform points lifted to the sphere (Malley); else
// uniform in solid angle.
struct InCone {
    alignas(64) Row x, y, z;
};
void in_cones(const uint32_t* number, const uint32_t* seed, const float* cosines, bool by_cosine,
              InCone& to) {
    double up[kSixteen], out[kSixteen], along_x[kSixteen], along_y[kSixteen];
    double u[kSixteen], turn[kSixteen];
    KINORA_SIXTEEN {
        const uint32_t k = number[i];
        u[i] = double(raytrace::owen_scramble_reversed(k, raytrace::first_scramble(seed[i]))) *
               0x1p-32;
        const uint32_t y = raytrace::sobol_second_reversed(k);
        turn[i] = double(raytrace::owen_scramble_reversed(y, raytrace::second_scramble(seed[i]))) *
                  0x1p-32;
    }
    KINORA_SIXTEEN {
        const double c = double(cosines[i]), square = c * c;
        double disc = __builtin_sqrt(1 - u[i] * (1 - square)), cap = 1 - u[i] * (1 - c);
        up[i] = by_cosine ? disc : cap;
        double left = 1 - up[i] * up[i];
        out[i] = __builtin_sqrt(left > 0 ? left : 0.0);
    }
    KINORA_SIXTEEN turn_to(turn[i], along_x[i], along_y[i]);
    KINORA_SIXTEEN {
        to.x[i] = float(out[i] * along_x[i]);
        to.y[i] = float(out[i] * along_y[i]);
        to.z[i] = float(up[i]);
    }
}

void directions(const Cone& cone, uint32_t first, uint32_t seed, float (&dir)[3][kSixteen]) {
    uint32_t number[kSixteen], seeds[kSixteen];
    float cosines[kSixteen];
    KINORA_SIXTEEN {
        number[i] = first + uint32_t(i);
        seeds[i] = seed;
        cosines[i] = cone.cosine;
    }
    InCone in;
    in_cones(number, seeds, cosines, cone.by_cosine, in);
    const float x[3] = {cone.x.x, cone.x.y, cone.x.z}, y[3] = {cone.y.x, cone.y.y, cone.y.z},
                z[3] = {cone.z.x, cone.z.y, cone.z.z};
    for (int k = 0; k < 3; ++k)
        KINORA_SIXTEEN dir[k][i] = in.x[i] * x[k] + in.y[i] * y[k] + in.z[i] * z[k];
}

// ---- lanes --------------------------------------------------------------------------------------

// An orthonormal basis without a branch: Duff et al., Building an Orthonormal Basis, Revisited,
// JCGT 2017.
void aim(RayLanes& lanes) {
    RayLanes& l = lanes;
    KINORA_SIXTEEN {
        const float ax = l.axis[0][i], ay = l.axis[1][i], az = l.axis[2][i];
        const float length = __builtin_sqrtf(ax * ax + ay * ay + az * az);
        const float zx = ax / length, zy = ay / length, zz = az / length;
        const float sign = __builtin_copysignf(1.0f, zz);
        const float a = -1.0f / (sign + zz), b = zx * zy * a;
        l.x[0][i] = 1.0f + sign * zx * zx * a;
        l.x[1][i] = sign * b;
        l.x[2][i] = -sign * zx;
        l.y[0][i] = b;
        l.y[1][i] = sign + zy * zy * a;
        l.y[2][i] = -zy;
        l.z[0][i] = zx;
        l.z[1][i] = zy;
        l.z[2][i] = zz;
    }
}

// One of two numbers, by bits alone, since compilers make branches of some choices.
__attribute__((always_inline)) inline float either(bool first, float a, float b) {
    const uint32_t mask = 0u - uint32_t(first);
    return __builtin_bit_cast(float, (__builtin_bit_cast(uint32_t, a) & mask) |
                                         (__builtin_bit_cast(uint32_t, b) & ~mask));
}

void start(const float* M, const float eye[3], const float at[3][kSixteen], RayLanes& lanes) {
    float m[9], e[3];
    __builtin_memcpy(m, M, sizeof(m));  // copies, which no store below can change
    __builtin_memcpy(e, eye, sizeof(e));
    const float eye_x = __builtin_fabsf(e[0]), eye_y = __builtin_fabsf(e[1]),
                eye_z = __builtin_fabsf(e[2]);
    const float eye_size[3] = {eye_x, eye_y, eye_z};
    RayLanes& l = lanes;
    KINORA_SIXTEEN {
        const float px = at[0][i], py = at[1][i], pz = at[2][i];
        const float x = l.P[0][i] - e[0], y = l.P[1][i] - e[1], z = l.P[2][i] - e[2];
        const bool there = (m[0] * x + m[3] * y + m[6] * z == px) &
                           (m[1] * x + m[4] * y + m[7] * z == py) &
                           (m[2] * x + m[5] * y + m[8] * z == pz);
        // gamma(4) of the magnitudes bounds a rotation and a sum.
        const float size = __builtin_fabsf(px) + __builtin_fabsf(py) + __builtin_fabsf(pz);
        for (int k = 0; k < 3; ++k) {
            const float free = m[3 * k] * px + m[3 * k + 1] * py + m[3 * k + 2] * pz + e[k];
            l.P[k][i] = either(there, l.P[k][i], free);
            l.error[k][i] = either(there, l.error[k][i], (size + eye_size[k]) * 2.4e-7f);
            l.Ng[k][i] = either(there, l.Ng[k][i], 0);
        }
    }
}

// ---- rays ---------------------------------------------------------------------------------------

// What the samples' lanes have.
template <class T>
__attribute__((always_inline)) inline void of_lanes(const T (&row)[kSixteen], const uint32_t* lane,
                                                    T (&to)[kSixteen]) {
#if defined(__AVX512F__)
    using Sixteen = uint32_t __attribute__((vector_size(64)));
    Sixteen numbers, which;
    __builtin_memcpy(&numbers, row, sizeof(numbers));
    __builtin_memcpy(&which, lane, sizeof(which));
    numbers = __builtin_shuffle(numbers, which);
    __builtin_memcpy(to, &numbers, sizeof(numbers));
#else
    for (int i = 0; i < kSixteen; ++i) to[i] = row[lane[i]];
#endif
}
__attribute__((always_inline)) inline void of_lanes(const Rows& rows, const uint32_t* lane,
                                                    Rows& to) {
    for (int k = 0; k < 3; ++k) of_lanes(rows[k], lane, to[k]);
}

void point(const RayLanes& lanes, const RaySamples& samples, const RayWants& wants,
           SixteenRays& rays) {
    const uint32_t* lane = samples.lane;
    alignas(64) Rows axis;
    of_lanes(lanes.axis, lane, axis);
    if (!wants.cones) {
        __builtin_memcpy(rays.dir, axis, sizeof(axis));
        return;
    }
    alignas(64) uint32_t seed[kSixteen], straight[kSixteen];
    alignas(64) Row cosines;
    alignas(64) Rows x, y, z;
    of_lanes(lanes.seed, lane, seed);
    of_lanes(lanes.straight, lane, straight);
    of_lanes(lanes.cosine, lane, cosines);
    of_lanes(lanes.x, lane, x);
    of_lanes(lanes.y, lane, y);
    of_lanes(lanes.z, lane, z);
    InCone in;
    in_cones(samples.number, seed, cosines, wants.by_cosine, in);
    for (int k = 0; k < 3; ++k) KINORA_SIXTEEN {
            const float d = in.x[i] * x[k][i] + in.y[i] * y[k][i] + in.z[i] * z[k][i];
            rays.dir[k][i] = either(straight[i] != 0, axis[k][i], d);
        }
}

void origins(const RayLanes& lanes, const uint32_t* lane, SixteenRays& rays) {
    alignas(64) Rows P, error, Ng;
    of_lanes(lanes.P, lane, P);
    of_lanes(lanes.error, lane, error);
    of_lanes(lanes.Ng, lane, Ng);
    KINORA_SIXTEEN {
        const float nx = Ng[0][i], ny = Ng[1][i], nz = Ng[2][i];
        const float ex = error[0][i], ey = error[1][i], ez = error[2][i];
        const float x = rays.dir[0][i], y = rays.dir[1][i], z = rays.dir[2][i];
        const bool known = (nx != 0) | (ny != 0) | (nz != 0);
        const float yz = ey > ez ? ey : ez;
        const float clear = 2 * (ex > yz ? ex : yz);
        const float scale = clear / __builtin_sqrtf(x * x + y * y + z * z);
        float box = __builtin_fabsf(nx) * ex + __builtin_fabsf(ny) * ey + __builtin_fabsf(nz) * ez;
        box = nx * x + ny * y + nz * z < 0 ? -box : box;
        for (int k = 0; k < 3; ++k) {
            const float step = box * Ng[k][i], at = P[k][i] + step;
            const float beyond = neighbour(at, step > 0);
            const float on_surface = either(step != 0, beyond, at);
            rays.org[k][i] = either(known, on_surface, P[k][i] + rays.dir[k][i] * scale);
        }
    }
}

// A ray that goes on spreads as itself, turned: panes are exact. One that goes back spreads as its
// mirror image and by the turn of the mirror's normal N (Igehy 1999, equations 15 and 16):
// dR = dD - 2 ((dD . N) N + (D . N) dN + (D . dN) N), with N half-way between the two ways.
void spreads(const RayLanes& lanes, const uint32_t* lane, SixteenRays& rays) {
    alignas(64) Rows in, Ng, dx, dy, Nx, Ny;
    of_lanes(lanes.in, lane, in);
    of_lanes(lanes.in_Ng, lane, Ng);
    of_lanes(lanes.dDdx, lane, dx);
    of_lanes(lanes.dDdy, lane, dy);
    of_lanes(lanes.dNdx, lane, Nx);
    of_lanes(lanes.dNdy, lane, Ny);
    alignas(64) Rows out, axis;
    alignas(64) Row square, scale, turns, sees;
    KINORA_SIXTEEN {
        float ix = in[0][i], iy = in[1][i], iz = in[2][i];
        float x = rays.dir[0][i], y = rays.dir[1][i], z = rays.dir[2][i];
        const float before = __builtin_sqrtf(ix * ix + iy * iy + iz * iz);
        const float after = __builtin_sqrtf(x * x + y * y + z * z);
        const bool sound = after > 0;
        sees[i] = before;
        ix /= before;
        iy /= before;
        iz /= before;
        x = either(sound, x / after, 0);
        y = either(sound, y / after, 0);
        z = either(sound, z / after, 0);
        scale[i] = either(sound, after / before, 0);
        const float nx = Ng[0][i], ny = Ng[1][i], nz = Ng[2][i];
        const float in_N = ix * nx + iy * ny + iz * nz;
        const float out_N = x * nx + y * ny + z * nz;
        const bool back = in_N * out_N < 0;
        const float sign = back ? -1.0f : 1.0f;
        turns[i] = back ? 0.0f : 1.0f;  // 1: it goes on, and is turned after it is mirrored
        const float p = x + sign * ix, q = y + sign * iy, r = z + sign * iz;
        in[0][i] = ix, in[1][i] = iy, in[2][i] = iz;
        out[0][i] = x, out[1][i] = y, out[2][i] = z;
        axis[0][i] = p, axis[1][i] = q, axis[2][i] = r;
        const float length2 = p * p + q * q + r * r;
        // Without an axis nothing is mirrored: what is divided by infinity is 0.
        square[i] = length2 > 1e-12f ? length2 : __builtin_inff();
    }
    auto turn = [&](const Rows& d, const Rows& dN, Rows& to) {
        KINORA_SIXTEEN {
            const float x = d[0][i], y = d[1][i], z = d[2][i];
            const float p = axis[0][i], q = axis[1][i], r = axis[2][i];
            const float twice = 2 * (in[0][i] * x + in[1][i] * y + in[2][i] * z);
            const float f = 2 * (p * x + q * y + r * z) / square[i];
            const float g = turns[i] * twice;
            // The unit axis is N. Of rays that go on nothing is added.
            const float unit = 2 * (1 - turns[i]) / __builtin_sqrtf(square[i]) * sees[i];
            const float ix = in[0][i], iy = in[1][i], iz = in[2][i];
            const float nx = dN[0][i], ny = dN[1][i], nz = dN[2][i];
            const float in_N = (p * ix + q * iy + r * iz) * unit;
            const float in_dN = (ix * nx + iy * ny + iz * nz) * unit;
            // Mirrored at in + out and then along out, `in` comes to lie on `out`.
            const bool seen = sees[i] > 0;
            const float tx = nx * in_N + p * in_dN, ty = ny * in_N + q * in_dN,
                        tz = nz * in_N + r * in_dN;
            to[0][i] = either(seen, (((x - p * f) + out[0][i] * g) - tx) * scale[i], 0);
            to[1][i] = either(seen, (((y - q * f) + out[1][i] * g) - ty) * scale[i], 0);
            to[2][i] = either(seen, (((z - r * f) + out[2][i] * g) - tz) * scale[i], 0);
        }
    };
    turn(dx, Nx, rays.dDdx);
    turn(dy, Ny, rays.dDdy);
}

void shoot(const RayLanes& lanes, const RaySamples& samples, const RayWants& wants,
           SixteenRays& rays) {
    const uint32_t* lane = samples.lane;
    point(lanes, samples, wants, rays);
    origins(lanes, lane, rays);
    if (wants.spreads) spreads(lanes, lane, rays);
    alignas(64) uint32_t seed[kSixteen];
    of_lanes(lanes.seed, lane, seed);
    KINORA_SIXTEEN rays.path[i] = raytrace::hash(seed[i], samples.number[i]);
    for (int c = 0; c < kCarried; ++c) of_lanes(lanes.carried[c], lane, rays.carried[c]);
}

}  // namespace

extern const RayKernels KINORA_KERNEL_TABLE(Rays);
const RayKernels KINORA_KERNEL_TABLE(Rays) = {KINORA_INSTRUCTION_SET, directions, aim, start,
                                              shoot};

}  // namespace kinora
