// runtime/columns/kernels_p.h: the kernels of kernels.h in plain C++. The compiler makes vectors of
// the loops, as wide as the file that includes this is compiled for. Every operation rounds once
// (no contraction) and in the order that glm has, so all widths give the same bits.
#pragma once

#include "runtime/columns/kernels.h"

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

using Four = float __attribute__((vector_size(16)));

// Four corners' x, y and z into places i to i + 3 of three rows.
__attribute__((always_inline)) inline void transpose(const float (*corner)[4], size_t i,
                                                     ThreeRows& to) {
    Four a, b, c, d;
    __builtin_memcpy(&a, corner[0], 16);
    __builtin_memcpy(&b, corner[1], 16);
    __builtin_memcpy(&c, corner[2], 16);
    __builtin_memcpy(&d, corner[3], 16);
    const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
               cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5),
               y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    const Four zab = __builtin_shufflevector(a, b, 2, 6, 2, 6),
               zcd = __builtin_shufflevector(c, d, 2, 6, 2, 6);
    const Four z = __builtin_shufflevector(zab, zcd, 0, 1, 4, 5);
    __builtin_memcpy(to[0] + i, &x, 16);
    __builtin_memcpy(to[1] + i, &y, 16);
    __builtin_memcpy(to[2] + i, &z, 16);
}

uint32_t mix_normals(const float* M, const CornerNormals& at, float* const to[3]) {
    alignas(64) ThreeRows n[3], mixed, turned;
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < kAll; i += 4) transpose(at.corner[k] + i, i, n[k]);
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kAll; ++i) {
            const float u = at.u[i], v = at.v[i];
            mixed[c][i] = (1 - u - v) * n[0][c][i] + u * n[1][c][i] + v * n[2][c][i];
        }
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

}  // namespace
}  // namespace kinora
