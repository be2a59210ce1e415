// raytrace/points/points_p.h: the kernels of points.h in plain C++. The compiler makes vectors of
// the loops, as wide as the file that includes this is compiled for. Every operation rounds once
// (no contraction), so all widths give the same bits.
#pragma once

#include "raytrace/points/points.h"
#include "runtime/base/kernel_math.h"

namespace kinora::raytrace {
namespace {

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

uint32_t sees_light(const TrianglePoints& at, const LeavingRays& from, float least_cosine) {
    constexpr float kNearUnit = 2e-3f;  // of squares: lengths are within half of that
    constexpr float kClear = 4e-3f;     // the mixture is off by no more than a quarter of that
    const float least = 1.02f * least_cosine * least_cosine;
    alignas(64) float n[3][3][kPoints];  // corner, component, point
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < kPoints; i += 4) corners_to_rows(at.corner[k] + i, i, n[k]);
    uint32_t seen[kPoints];
    for (size_t i = 0; i < kPoints; ++i) {
        const float wx = from.way[0][i], wy = from.way[1][i], wz = from.way[2][i];
        const float gx = from.Ng[0][i], gy = from.Ng[1][i], gz = from.Ng[2][i];
        const float square = wx * wx + wy * wy + wz * wz;
        const float cosine = gx * wx + gy * wy + gz * wz;
        const float weight[3] = {1.0f - at.u[i] - at.v[i], at.u[i], at.v[i]};
        float mx = 0, my = 0, mz = 0;
        uint32_t sure = cosine * cosine > least * square;
        for (int k = 0; k < 3; ++k) {
            const float x = n[k][0][i], y = n[k][1][i], z = n[k][2][i];
            sure &= uint32_t(__builtin_fabsf(x * x + y * y + z * z - 1) < kNearUnit);
            mx += weight[k] * x;
            my += weight[k] * y;
            mz += weight[k] * z;
        }
        const float of_facet = mx * gx + my * gy + mz * gz, of_light = mx * wx + my * wy + mz * wz;
        sure &= uint32_t(__builtin_fabsf(of_facet) > kClear) &
                uint32_t(of_light * of_light > kClear * kClear * square) &
                (uint32_t(of_facet < 0) ^ uint32_t(of_light < 0) ^ uint32_t(cosine < 0) ^ 1u);
        uint32_t same = 1;
        for (int c = 0; c < 3; ++c)
            same &= uint32_t(n[0][c][i] == n[1][c][i]) & uint32_t(n[0][c][i] == n[2][c][i]);
        seen[i] = (sure | same) << i;
    }
    uint32_t all = 0;
    for (size_t i = 0; i < kPoints; ++i) all |= seen[i];
    return all;
}

}  // namespace

extern const PointKernels KINORA_KERNEL_TABLE(Points);
const PointKernels KINORA_KERNEL_TABLE(Points) = {
    KINORA_INSTRUCTION_SET, interpolate, normalize, sound, footprint, leave, sees_light};

}  // namespace kinora::raytrace
