// runtime/rays/ray_kernels_p.h: the kernels, loops over sixteen that the compiler makes vectors of.
// Included by one file for each instruction set; all names are the file's own.
#pragma once

#include "raytrace/random/bits.h"
#include "runtime/rays/ray_kernels.h"

namespace kinora {
namespace {

// No function of a library is called here: compiled for this instruction set, it could be the one
// that the linker takes for all of the program.
struct Three {
    float v[3];
};
inline Three three(const vec3& a) {
    return {{a.x, a.y, a.z}};
}

#define KINORA_SIXTEEN _Pragma("GCC ivdep") for (int i = 0; i < kSixteen; ++i)

// ---- sine and cosine of 2 pi turn, turn in [0, 1) -----------------------------------------------

// Taylor series on [-pi/4, pi/4], to the last bits of a double: the term left out is under 2^-58.
inline double sine(double x) {
    double s = x * x;
    double p = -7.6471637318198164759e-13;
    p = p * s + 1.6059043836821614599e-10;
    p = p * s - 2.5052108385441718775e-8;
    p = p * s + 2.7557319223985890653e-6;
    p = p * s - 1.9841269841269841270e-4;
    p = p * s + 8.3333333333333333333e-3;
    p = p * s - 1.6666666666666666667e-1;
    return x + x * (s * p);
}
inline double cosine(double x) {
    double s = x * x;
    double p = 4.7794773323873852974e-14;
    p = p * s - 1.1470745597729724714e-11;
    p = p * s + 2.0876756987868098979e-9;
    p = p * s - 2.7557319223985890653e-7;
    p = p * s + 2.4801587301587301587e-5;
    p = p * s - 1.3888888888888888889e-3;
    p = p * s + 4.1666666666666666667e-2;
    return (1 - 0.5 * s) + s * s * p;
}

// By cosine: a disc's uniform points lifted to the sphere (Malley); else uniform in solid angle.
void directions(const Cone& cone, uint32_t first, uint32_t seed, SixteenRays& rays) {
    const uint32_t seed_x = raytrace::first_scramble(seed);
    const uint32_t seed_y = raytrace::second_scramble(seed);
    const double c = double(cone.cosine), square = c * c;
    const bool by_cosine = cone.by_cosine;
    double up[kSixteen], out[kSixteen], along_x[kSixteen], along_y[kSixteen];
    double u[kSixteen], turn[kSixteen];
    KINORA_SIXTEEN {
        uint32_t k = first + uint32_t(i);
        u[i] = double(raytrace::owen_scramble_reversed(k, seed_x)) * 0x1p-32;
        const uint32_t y = raytrace::sobol_second_reversed(k);
        turn[i] = double(raytrace::owen_scramble_reversed(y, seed_y)) * 0x1p-32;
    }
    KINORA_SIXTEEN {
        double disc = __builtin_sqrt(1 - u[i] * (1 - square)), cap = 1 - u[i] * (1 - c);
        up[i] = by_cosine ? disc : cap;
        double left = 1 - up[i] * up[i];
        out[i] = __builtin_sqrt(left > 0 ? left : 0.0);
    }
    KINORA_SIXTEEN {
        // The nearest quarter turn and what is left of it.
        double quarter = double(int32_t(turn[i] * 4 + 0.5));
        double rest = (turn[i] - quarter * 0.25) * 6.283185307179586477;
        double s = sine(rest), co = cosine(rest);
        bool odd = quarter == 1 || quarter == 3;
        double cx = odd ? s : co, sx = odd ? co : s;
        along_x[i] = quarter == 1 || quarter == 2 ? -cx : cx;
        along_y[i] = quarter == 2 || quarter == 3 ? -sx : sx;
    }
    float a[kSixteen], b[kSixteen], e[kSixteen];
    KINORA_SIXTEEN {
        a[i] = float(out[i] * along_x[i]);
        b[i] = float(out[i] * along_y[i]);
        e[i] = float(up[i]);
    }
    const Three x = three(cone.x), y = three(cone.y), z = three(cone.z);
    for (int k = 0; k < 3; ++k)
        KINORA_SIXTEEN rays.dir[k][i] = a[i] * x.v[k] + b[i] * y.v[k] + e[i] * z.v[k];
}

// ---- origins and spreads ------------------------------------------------------------------------

inline float dot(const Three& a, const Three& b) {
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}
inline float magnitude(float x) {
    return __builtin_fabsf(x);
}

// x one float up or down.
inline float stepped(float x, bool is_up) {
    uint32_t bits;
    __builtin_memcpy(&bits, &x, 4);
    bits = is_up == (x > 0) ? bits + 1 : bits - 1;
    bits = x == 0 ? (is_up ? 1u : 0x80000001u) : bits;
    __builtin_memcpy(&x, &bits, 4);
    return x;
}

void origins(const RaySource& source, SixteenRays& rays) {
    const Three P = three(source.P), error = three(source.error), Ng = three(source.Ng);
    if (Ng.v[0] == 0 && Ng.v[1] == 0 && Ng.v[2] == 0) {
        float most = error.v[1] > error.v[2] ? error.v[1] : error.v[2];
        float clear = 2 * (error.v[0] > most ? error.v[0] : most);
        float scale[kSixteen];
        KINORA_SIXTEEN {
            float x = rays.dir[0][i], y = rays.dir[1][i], z = rays.dir[2][i];
            scale[i] = clear / __builtin_sqrtf(x * x + y * y + z * z);
        }
        for (int k = 0; k < 3; ++k)
            KINORA_SIXTEEN rays.org[k][i] = P.v[k] + rays.dir[k][i] * scale[i];
        return;
    }
    float box = magnitude(Ng.v[0]) * error.v[0] + magnitude(Ng.v[1]) * error.v[1] +
                magnitude(Ng.v[2]) * error.v[2];
    float over[3], under[3];  // the places on either side of the surface
    for (int k = 0; k < 3; ++k) {
        float step = box * Ng.v[k];
        over[k] = step == 0 ? P.v[k] + step : stepped(P.v[k] + step, step > 0);
        under[k] = step == 0 ? P.v[k] - step : stepped(P.v[k] - step, step < 0);
    }
    float side[kSixteen];
    KINORA_SIXTEEN side[i] =
        Ng.v[0] * rays.dir[0][i] + Ng.v[1] * rays.dir[1][i] + Ng.v[2] * rays.dir[2][i];
    for (int k = 0; k < 3; ++k) KINORA_SIXTEEN rays.org[k][i] = side[i] < 0 ? under[k] : over[k];
}

// A ray that goes back spreads as its mirror image, one that goes on as itself, turned. Lengths
// stay, so flat mirrors and panes are exact.
void spreads(const RaySource& source, SixteenRays& rays) {
    Three in = three(source.in);
    const Three Ng = three(source.in_Ng);
    float before = __builtin_sqrtf(dot(in, in));
    if (!(before > 0)) {
        __builtin_memset(rays.dDdx, 0, sizeof(rays.dDdx));
        __builtin_memset(rays.dDdy, 0, sizeof(rays.dDdy));
        return;
    }
    for (float& x : in.v) x /= before;
    float in_N = dot(in, Ng);
    float out[3][kSixteen], axis[3][kSixteen], square[kSixteen], scale[kSixteen];
    float turns[kSixteen];  // 1: the ray goes on, and is turned after it is mirrored
    KINORA_SIXTEEN {
        float x = rays.dir[0][i], y = rays.dir[1][i], z = rays.dir[2][i];
        float after = __builtin_sqrtf(x * x + y * y + z * z);
        bool sound = after > 0;
        x = sound ? x / after : 0.0f;
        y = sound ? y / after : 0.0f;
        z = sound ? z / after : 0.0f;
        scale[i] = sound ? after / before : 0.0f;
        float out_N = x * Ng.v[0] + y * Ng.v[1] + z * Ng.v[2];
        bool back = in_N * out_N < 0;
        float sign = back ? -1.0f : 1.0f;
        turns[i] = back ? 0.0f : 1.0f;
        float p = x + sign * in.v[0], q = y + sign * in.v[1], r = z + sign * in.v[2];
        out[0][i] = x, out[1][i] = y, out[2][i] = z;
        axis[0][i] = p, axis[1][i] = q, axis[2][i] = r;
        float length2 = p * p + q * q + r * r;
        // Without an axis nothing is mirrored: what is divided by infinity is 0.
        square[i] = length2 > 1e-12f ? length2 : __builtin_inff();
    }
    auto turn = [&](const Three& d, float(&to)[3][kSixteen]) {
        float twice = 2 * dot(in, d);
        KINORA_SIXTEEN {
            float p = axis[0][i], q = axis[1][i], r = axis[2][i];
            float f = 2 * (p * d.v[0] + q * d.v[1] + r * d.v[2]) / square[i];
            float g = turns[i] * twice;
            // Mirrored at in + out and then along out, `in` comes to lie on `out`.
            to[0][i] = ((d.v[0] - p * f) + out[0][i] * g) * scale[i];
            to[1][i] = ((d.v[1] - q * f) + out[1][i] * g) * scale[i];
            to[2][i] = ((d.v[2] - r * f) + out[2][i] * g) * scale[i];
        }
    };
    turn(three(source.dDdx), rays.dDdx);
    turn(three(source.dDdy), rays.dDdy);
}

void leave(const RaySource& source, SixteenRays& rays) {
    origins(source, rays);
    spreads(source, rays);
}

}  // namespace
}  // namespace kinora
