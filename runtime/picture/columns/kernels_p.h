// runtime/picture/columns/kernels_p.h: the kernels of kernels.h in plain C++. The compiler makes
// vectors of the loops, as wide as the file that includes this is compiled for. Every operation
// rounds once (no contraction) and in the order that glm has, so all widths give the same bits.
#pragma once

#include "raytrace/points/points.h"
#include "raytrace/random/bits.h"
#include "runtime/base/kernel_math.h"
#include "runtime/picture/columns/kernels.h"

namespace kinora {
namespace {

constexpr size_t kAll = kColumnPoints;
using ThreeRows = float[3][kAll];

// M a, of what is in three rows, to columns that may lie anywhere.
__attribute__((always_inline)) inline void turn_rows(const float* M, const ThreeRows& a,
                                                     float* const to[3]) {
    float m[9];
    __builtin_memcpy(m, M, sizeof(m));  // copies, which no store below can change
    alignas(64) ThreeRows out;
    for (size_t i = 0; i < kAll; ++i) {
        const float x = a[0][i], y = a[1][i], z = a[2][i];
        out[0][i] = m[0] * x + m[3] * y + m[6] * z;
        out[1][i] = m[1] * x + m[4] * y + m[7] * z;
        out[2][i] = m[2] * x + m[5] * y + m[8] * z;
    }
    for (int k = 0; k < 3; ++k) __builtin_memcpy(to[k], out[k], sizeof(out[k]));
}

void turn(const float* M, const TripleColumns& a, float* const to[3]) {
    alignas(64) ThreeRows rows;
    for (int k = 0; k < 3; ++k) __builtin_memcpy(rows[k], a.c[k], sizeof(rows[k]));
    turn_rows(M, rows, to);
}

void turn_from(const float* M, const TripleColumns& a, const float b[3], float* const to[3]) {
    alignas(64) ThreeRows rows;
    for (int k = 0; k < 3; ++k) {
        const float* from = a.c[k];
        const float less = b[k];
        for (size_t i = 0; i < kAll; ++i) rows[k][i] = from[i] - less;
    }
    turn_rows(M, rows, to);
}

void turn_between(const float* M, const TripleColumns& a, const TripleColumns& b,
                  float* const to[3]) {
    alignas(64) ThreeRows rows;
    for (int k = 0; k < 3; ++k) {
        const float *from = a.c[k], *less = b.c[k];
        for (size_t i = 0; i < kAll; ++i) rows[k][i] = from[i] - less[i];
    }
    turn_rows(M, rows, to);
}

// What is known of the smooth surface between three normals.
void find_kinds(const ThreeRows (&n)[3], const ThreeRows& mixed, uint32_t* kinds) {
    constexpr float kNearUnit = 1.9e-3f;  // of squares: lengths are within half of that
    constexpr float kLeastMixed = 0.25f;  // squared length of a mixture that directions hold for
    for (size_t i = 0; i < kAll; ++i) {
        uint32_t unit = 1, same = 1;
        for (int k = 0; k < 3; ++k) {
            const float x = n[k][0][i], y = n[k][1][i], z = n[k][2][i];
            unit &= uint32_t(__builtin_fabsf(x * x + y * y + z * z - 1) < kNearUnit);
            same &=
                uint32_t(x == n[0][0][i]) & uint32_t(y == n[0][1][i]) & uint32_t(z == n[0][2][i]);
        }
        const float x = mixed[0][i], y = mixed[1][i], z = mixed[2][i];
        unit &= uint32_t(x * x + y * y + z * z > kLeastMixed);
        kinds[i] = same ? raytrace::kOneNormal : unit * raytrace::kUnitNormals;
    }
}

uint32_t mix_normals(const float* M, const CornerNormals& at, float* const to[3], uint32_t* kinds) {
    alignas(64) ThreeRows n[3], mixed, turned;
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < kAll; i += 4) corners_to_rows(at.corner[k] + i, i, n[k]);
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kAll; ++i) {
            const float u = at.u[i], v = at.v[i];
            mixed[c][i] = (1 - u - v) * n[0][c][i] + u * n[1][c][i] + v * n[2][c][i];
        }
    find_kinds(n, mixed, kinds);
    float* const rows[3] = {turned[0], turned[1], turned[2]};
    turn_rows(M, mixed, rows);
    uint32_t unsound[kAll];
    for (size_t i = 0; i < kAll; ++i) {
        const float x = turned[0][i], y = turned[1][i], z = turned[2][i];
        const float square = x * x + y * y + z * z, length = __builtin_sqrtf(square);
        turned[0][i] = x / length;
        turned[1][i] = y / length;
        turned[2][i] = z / length;
        unsound[i] = (square > 0) & (square < __builtin_inff()) ? 0u : 1u << i;
    }
    for (int k = 0; k < 3; ++k) __builtin_memcpy(to[k], turned[k], sizeof(turned[k]));
    uint32_t all = 0;
    for (size_t i = 0; i < kAll; ++i) all |= unsound[i];
    return all;
}

__attribute__((always_inline)) inline float larger(float a, float b) {
    return a < b ? b : a;
}

// Of two numbers the first where the mask is all ones, the other where it is 0: bits alone, since
// compilers make branches of choices between quotients.
__attribute__((always_inline)) inline float chosen(uint32_t mask, float a, float b) {
    return __builtin_bit_cast(float, (__builtin_bit_cast(uint32_t, a) & mask) |
                                         (__builtin_bit_cast(uint32_t, b) & ~mask));
}
__attribute__((always_inline)) inline double or_zero(uint64_t mask, double a) {
    return __builtin_bit_cast(double, __builtin_bit_cast(uint64_t, a) & mask);
}

void find_parameters(OnTriangles& on, const CornerNumbers& s, const CornerNumbers& t, TwoRows& st,
                     TwoRows& uv) {
#pragma GCC ivdep
    for (size_t i = 0; i < kAll; ++i) {
        const float s0 = s.at[0][i], t0 = t.at[0][i], u = on.u[i], v = on.v[i];
        const float du1 = s.at[1][i] - s0, dv1 = t.at[1][i] - t0;
        const float du2 = s.at[2][i] - s0, dv2 = t.at[2][i] - t0;
        const float found_s = s0 + u * du1 + v * du2, found_t = t0 + u * dv1 + v * dv2;
        const float x = du1 * dv2, y = du2 * dv1, det = x - y, size = __builtin_fabsf(det);
        const float scale = larger(__builtin_fabsf(x), __builtin_fabsf(y));
        const uint32_t has_area = 0u - (uint32_t(size > 1e-6f * scale) & uint32_t(size > 1e-30f));
        on.inv[0][0][i] = chosen(has_area, dv2 / det, 1);
        on.inv[0][1][i] = chosen(has_area, -dv1 / det, 0);
        on.inv[1][0][i] = chosen(has_area, -du2 / det, 0);
        on.inv[1][1][i] = chosen(has_area, du1 / det, 1);
        st.at[0][i] = found_s;
        st.at[1][i] = found_t;
        uv.at[0][i] = chosen(has_area, found_s, u);
        uv.at[1][i] = chosen(has_area, found_t, v);
    }
}

void mix(const OnTriangles& on, const CornerNumbers& x, float* value, TwoRows& along) {
    alignas(64) float mixed[kAll];
    for (size_t i = 0; i < kAll; ++i) {
        const float x0 = x.at[0][i], d1 = x.at[1][i] - x0, d2 = x.at[2][i] - x0;
        mixed[i] = x0 + on.u[i] * d1 + on.v[i] * d2;
        along.at[0][i] = on.inv[0][0][i] * d1 + on.inv[0][1][i] * d2;
        along.at[1][i] = on.inv[1][0][i] * d1 + on.inv[1][1][i] * d2;
    }
    __builtin_memcpy(value, mixed, sizeof(mixed));
}

void tangents(const float* M, const OnTriangles& on, const CornerPlaces& places,
              TripleRows& along_u, TripleRows& along_v) {
    alignas(64) ThreeRows p[3], e1, e2;
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < kAll; i += 4) corners_to_rows(places.at[k] + i, i, p[k]);
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kAll; ++i) {
            e1[c][i] = p[1][c][i] - p[0][c][i];
            e2[c][i] = p[2][c][i] - p[0][c][i];
        }
    float* const to1[3] = {e1[0], e1[1], e1[2]};
    float* const to2[3] = {e2[0], e2[1], e2[2]};
    turn_rows(M, e1, to1);
    turn_rows(M, e2, to2);
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kAll; ++i) {
            along_u.at[c][i] = on.inv[0][0][i] * e1[c][i] + on.inv[0][1][i] * e2[c][i];
            along_v.at[c][i] = on.inv[1][0][i] * e1[c][i] + on.inv[1][1][i] * e2[c][i];
        }
}

__attribute__((always_inline)) inline double dot(const TripleRows& a, const TripleRows& b,
                                                 size_t i) {
    return double(a.at[0][i]) * double(b.at[0][i]) + double(a.at[1][i]) * double(b.at[1][i]) +
           double(a.at[2][i]) * double(b.at[2][i]);
}

void extents(const TripleRows& dPdu, const TripleRows& dPdv, const TripleRows& dPdx,
             const TripleRows& dPdy, TwoRows& found) {
#pragma GCC ivdep
    for (size_t i = 0; i < kAll; ++i) {
        const double a = dot(dPdu, dPdu, i), b = dot(dPdu, dPdv, i), c = dot(dPdv, dPdv, i);
        const double det = a * c - b * b, inverse = or_zero(0u - uint64_t(det > 0), 1 / det);
        const double ux = dot(dPdu, dPdx, i), vx = dot(dPdv, dPdx, i);
        const double uy = dot(dPdu, dPdy, i), vy = dot(dPdv, dPdy, i);
        const float along_x[2] = {float((c * ux - b * vx) * inverse),
                                  float((a * vx - b * ux) * inverse)};
        const float along_y[2] = {float((c * uy - b * vy) * inverse),
                                  float((a * vy - b * uy) * inverse)};
        for (int k = 0; k < 2; ++k)
            found.at[k][i] = larger(__builtin_fabsf(along_x[k]), __builtin_fabsf(along_y[k]));
    }
}

// As random_of() of raytrace/hits.h.
void random(const HitNumbers& hits, uint32_t depth, uint32_t frame_seed, uint32_t* to) {
    const HitNumbers h = hits;  // copies, which no store below can change
    const uint32_t frame = raytrace::hash(frame_seed);
#pragma GCC ivdep
    for (size_t i = 0; i < kAll; ++i) {
        const uint32_t pixel = raytrace::hash(h.pixel_x[i], h.pixel_y[i]) ^ frame;
        const uint32_t layer = h.layer[i] % 64 + 64 * depth + (h.layer[i] / 64 << 16);
        to[i] = raytrace::hash(pixel, h.sample[i], layer);
    }
}

}  // namespace

extern const ColumnKernels KINORA_KERNEL_TABLE(Columns);
const ColumnKernels KINORA_KERNEL_TABLE(Columns) = {
    KINORA_INSTRUCTION_SET, turn, turn_from, turn_between, mix_normals,
    find_parameters,        mix,  tangents,  extents,      random};

}  // namespace kinora
