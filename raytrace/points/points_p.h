// raytrace/points/points_p.h: the kernels of points.h in plain C++. The compiler makes vectors of
// the loops, as wide as the file that includes this is compiled for. Every operation rounds once
// (no contraction), so all widths give the same bits.
#pragma once

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "raytrace/points/points.h"
#include "runtime/base/kernel_math.h"

namespace kinora::raytrace {
namespace {

#if defined(__AVX512F__)
using Sixteen = uint32_t __attribute__((vector_size(64)));
#endif

#if defined(__AVX512F__)
void keep(uint32_t lanes, const KeptColumn* columns, size_t count, size_t first, size_t at) {
    const __m512i all = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const auto which = Sixteen(_mm512_maskz_compress_epi32(__mmask16(lanes), all));
    for (size_t c = 0; c < count; ++c) {
        Sixteen row;
        __builtin_memcpy(&row, static_cast<const uint32_t*>(columns[c].from) + first, sizeof(row));
        row = __builtin_shuffle(row, which);
        __builtin_memcpy(static_cast<uint32_t*>(columns[c].to) + at, &row, sizeof(row));
    }
}
#else
void keep(uint32_t lanes, const KeptColumn* columns, size_t count, size_t first, size_t at) {
    uint32_t lane[kPoints] = {};
    size_t n = 0;
    for (uint32_t left = lanes; left; left &= left - 1) lane[n++] = uint32_t(__builtin_ctz(left));
    for (size_t c = 0; c < count; ++c) {
        uint32_t row[kPoints], kept[kPoints];
        const char* from = static_cast<const char*>(columns[c].from) + first * sizeof(uint32_t);
        char* to = static_cast<char*>(columns[c].to) + at * sizeof(uint32_t);
        __builtin_memcpy(row, from, sizeof(row));
        for (size_t i = 0; n < kPoints && i < kPoints; ++i) kept[i] = row[lane[i]];
        __builtin_memcpy(to, n < kPoints ? kept : row, sizeof(row));
    }
}
#endif

void pick(const uint32_t* rows, const KeptColumn* columns, size_t count) {
#if defined(__AVX512F__)
    const size_t base = rows[0] / kPoints * kPoints;
    const bool two = rows[kPoints - 1] - base >= kPoints;  // blocks
    if (rows[kPoints - 1] - base < 2 * kPoints) {
        Sixteen which, low, high;
        __builtin_memcpy(&which, rows, sizeof(which));
        which -= uint32_t(base);
        for (size_t c = 0; c < count; ++c) {
            const char* from = static_cast<const char*>(columns[c].from) + base * sizeof(uint32_t);
            __builtin_memcpy(&low, from, sizeof(low));
            __builtin_memcpy(&high, two ? from + sizeof(low) : from, sizeof(high));
            low = __builtin_shuffle(low, high, which);
            __builtin_memcpy(columns[c].to, &low, sizeof(low));
        }
        return;
    }
#endif
    const bool dense = rows[kPoints - 1] - rows[0] == kPoints - 1;
    for (size_t c = 0; c < count; ++c) {
        const uint32_t* from = static_cast<const uint32_t*>(columns[c].from);
        alignas(64) uint32_t found[kPoints];
        if (dense)
            __builtin_memcpy(found, from + rows[0], sizeof(found));
        else
            for (size_t i = 0; i < kPoints; ++i) found[i] = from[rows[i]];
        __builtin_memcpy(columns[c].to, found, sizeof(found));
    }
}

uint32_t interpolate(const TrianglePoints& at, float error_scale, float least, float most,
                     PointBlock& out) {
    float p[3][3][kPoints];  // corner, component, point
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < kPoints; i += 4) corners_to_rows(at.corner[k] + i, i, p[k]);
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kPoints; ++i) {
            const float x = (1.0f - at.u[i] - at.v[i]) * p[0][c][i], y = at.u[i] * p[1][c][i],
                        z = at.v[i] * p[2][c][i];
            out.P[c][i] = x + y + z;
            out.error[c][i] =
                error_scale * (__builtin_fabsf(x) + __builtin_fabsf(y) + __builtin_fabsf(z));
        }
    uint32_t outside[kPoints];
    for (size_t i = 0; i < kPoints; ++i) {
        const float ex = p[1][0][i] - p[0][0][i], ey = p[1][1][i] - p[0][1][i],
                    ez = p[1][2][i] - p[0][2][i];
        const float fx = p[2][0][i] - p[0][0][i], fy = p[2][1][i] - p[0][1][i],
                    fz = p[2][2][i] - p[0][2][i];
        const float x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
        const float square = x * x + y * y + z * z;
        out.N[0][i] = x;
        out.N[1][i] = y;
        out.N[2][i] = z;
        outside[i] = (square > least) & (square < most) ? 0u : 1u << i;  // NaN is outside
    }
    uint32_t all = 0;
    for (size_t i = 0; i < kPoints; ++i) all |= outside[i];
    return all;
}

void normalize(PointBlock& block) {
    for (size_t i = 0; i < kPoints; ++i) {
        const float x = block.N[0][i], y = block.N[1][i], z = block.N[2][i];
        const float square = x * x + y * y + z * z;
        const float inverse = 1.0f / __builtin_sqrtf(square);
        const float scale = square > 0 ? inverse : 0.0f;
        block.N[0][i] = x * scale;
        block.N[1][i] = y * scale;
        block.N[2][i] = z * scale;
    }
}

bool sound(const PacketRays& rays, float far, float least, float most) {
    const PacketRays r = rays;
    uint32_t good = 1;
    for (size_t i = 0; i < kPoints; ++i) {
        const float x = r.dir[0][i], y = r.dir[1][i], z = r.dir[2][i];
        const float square = x * x + y * y + z * z;
        good &= uint32_t(__builtin_fabsf(r.org[0][i]) <= far) &
                uint32_t(__builtin_fabsf(r.org[1][i]) <= far) &
                uint32_t(__builtin_fabsf(r.org[2][i]) <= far) & uint32_t(square >= least) &
                uint32_t(square <= most) & uint32_t(r.tnear[i] >= 0) &
                uint32_t(r.tnear[i] <= __FLT_MAX__) & uint32_t(r.tnear[i] <= r.tfar[i]);
    }
    return good != 0;
}

void footprint(const FootprintRays& rays, float least_cosine, float* const dP[3]) {
    const FootprintRays r = rays;  // copies, which no store below can change
    float *x = dP[0], *y = dP[1], *z = dP[2];
#pragma GCC ivdep
    for (size_t i = 0; i < kPoints; ++i) {
        const float t = r.t[i], dx = r.dir[0][i], dy = r.dir[1][i], dz = r.dir[2][i];
        const float nx = r.Ng[0][i], ny = r.Ng[1][i], nz = r.Ng[2][i];
        const float qx = r.dO[0][i] + t * r.dD[0][i], qy = r.dO[1][i] + t * r.dD[1][i],
                    qz = r.dO[2][i] + t * r.dD[2][i];
        // From 0 on, so that -0 comes out as the sum of one by one.
        float cosine = ((0.0f + nx * dx) + ny * dy) + nz * dz;
        const float along = ((0.0f + nx * qx) + ny * qy) + nz * qz;
        const float capped = __builtin_copysignf(least_cosine, cosine);
        cosine = __builtin_fabsf(cosine) < least_cosine ? capped : cosine;
        const float back = along / cosine;
        x[i] = qx - back * dx;
        y[i] = qy - back * dy;
        z[i] = qz - back * dz;
    }
}

// Pharr, Jakob, Humphreys, 6.8.6, as in offset_ray_origin().
void leave(const LeavingRays& from, float* const org[3], float* const dir[3], float* tfar) {
    alignas(64) float O[3][kPoints], D[3][kPoints], T[kPoints];
    for (size_t i = 0; i < kPoints; ++i) {
        const float wx = from.way[0][i], wy = from.way[1][i], wz = from.way[2][i];
        const float ux = from.up[0][i], uy = from.up[1][i], uz = from.up[2][i];
        const bool lifted = (ux != 0) | (uy != 0) | (uz != 0);
        float nx = from.Ng[0][i], ny = from.Ng[1][i], nz = from.Ng[2][i];
        const bool known = (nx != 0) | (ny != 0) | (nz != 0);
        const float inverse = 1.0f / __builtin_sqrtf(wx * wx + wy * wy + wz * wz);
        nx = known ? nx : wx * inverse;
        ny = known ? ny : wy * inverse;
        nz = known ? nz : wz * inverse;
        const float px = from.P[0][i], py = from.P[1][i], pz = from.P[2][i];
        float d = __builtin_fabsf(nx) * from.error[0][i] + __builtin_fabsf(ny) * from.error[1][i] +
                  __builtin_fabsf(nz) * from.error[2][i];
        const float ax = lifted ? ux : wx, ay = lifted ? uy : wy, az = lifted ? uz : wz;
        d = nx * ax + ny * ay + nz * az < 0 ? -d : d;
        const float n[3] = {nx, ny, nz}, p[3] = {px, py, pz}, w[3] = {wx, wy, wz};
        const bool endless = from.endless[i] != 0;
        for (int c = 0; c < 3; ++c) {
            const float raised = p[c] + from.up[c][i], step = d * n[c];
            const float at = (lifted ? raised : p[c]) + step;
            const float beyond = neighbour(at, step > 0);
            const float o = step != 0 ? beyond : at;
            const float end = ((p[c] + w[c]) - o) + from.short_of[c][i];
            O[c][i] = o;
            D[c][i] = endless ? w[c] : end;
        }
        T[i] = endless ? __builtin_inff() : 1.0f;
    }
    for (int c = 0; c < 3; ++c) {
        __builtin_memcpy(org[c], O[c], sizeof(T));
        __builtin_memcpy(dir[c], D[c], sizeof(T));
    }
    __builtin_memcpy(tfar, T, sizeof(T));
}

uint32_t sees_light(const LeavingRays& from, const float* const N[3], const uint32_t* normals,
                    float least_cosine) {
    constexpr float kClear = 1e-2f;  // N is off by no more than a third of that
    const float least = 1.02f * least_cosine * least_cosine;
    const float *nx = N[0], *ny = N[1], *nz = N[2];
    uint32_t seen[kPoints];
    for (size_t i = 0; i < kPoints; ++i) {
        const float wx = from.way[0][i], wy = from.way[1][i], wz = from.way[2][i];
        const float gx = from.Ng[0][i], gy = from.Ng[1][i], gz = from.Ng[2][i];
        const float square = wx * wx + wy * wy + wz * wz;
        const float cosine = gx * wx + gy * wy + gz * wz;
        const float of_facet = nx[i] * gx + ny[i] * gy + nz[i] * gz;
        const float of_light = nx[i] * wx + ny[i] * wy + nz[i] * wz;
        const uint32_t sure =
            uint32_t(cosine * cosine > least * square) &
            uint32_t(__builtin_fabsf(of_facet) > kClear) &
            uint32_t(of_light * of_light > kClear * kClear * square) &
            (uint32_t(of_facet < 0) ^ uint32_t(of_light < 0) ^ uint32_t(cosine < 0) ^ 1u);
        const uint32_t kind = normals[i];
        seen[i] = ((sure & uint32_t(kind == kUnitNormals)) | uint32_t(kind == kOneNormal)) << i;
    }
    uint32_t all = 0;
    for (size_t i = 0; i < kPoints; ++i) all |= seen[i];
    return all;
}

}  // namespace

extern const PointKernels KINORA_KERNEL_TABLE(Points);
const PointKernels KINORA_KERNEL_TABLE(Points) = {
    KINORA_INSTRUCTION_SET, keep, pick, interpolate, normalize, sound, footprint, leave, sees_light};

}  // namespace kinora::raytrace
