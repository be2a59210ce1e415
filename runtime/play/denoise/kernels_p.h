// runtime/play/denoise/kernels_p.h: the kernels of kernels.h in plain C++. The compiler makes
// vectors of the loops, as wide as the file that includes this is compiled for. Every operation
// rounds once and in the same order, so all widths give the same bits.
#pragma once

#include "runtime/play/denoise/kernels.h"

namespace kinora {
namespace {

constexpr size_t kRun = kFilterRun;
using Row = float[kRun];

// Of Rec. 709, IEC 61966-2-1.
__attribute__((always_inline)) inline float brightness(float r, float g, float b) {
    return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

constexpr float kOtherDepth = 100;   // one over the share of a depth that planes may lie apart
constexpr float kOtherAlbedo = 400;  // by its square
constexpr float kNoise = 1 / 6.0f;   // one over the square of the deviations that noise has
constexpr float kLeastVariance = 1e-7f;

struct Sums {
    alignas(64) Row c[4];
    alignas(64) Row weight, variance;
};

// What does not depend on the other pixel.
struct Here {
    alignas(64) Row bright, by_noise, by_depth;
};

__attribute__((always_inline)) inline void add_tap(const FilterGuide& g, const FilterColors& from,
                                                   const Here& here, float share, float right,
                                                   float below, ptrdiff_t at, Sums& sums) {
    const float *nx = g.N[0], *ny = g.N[1], *nz = g.N[2], *depth = g.depth, *albedo = g.albedo;
    const float *along_x = g.slope[0], *along_y = g.slope[1];
    const uint32_t* surface = g.surface;
    const float *r = from.c[0] + at, *green = from.c[1] + at, *b = from.c[2] + at,
                *a = from.c[3] + at, *variance = from.variance + at;
    const float *nx2 = nx + at, *ny2 = ny + at, *nz2 = nz + at, *depth2 = depth + at,
                *albedo2 = albedo + at;
    const uint32_t* surface2 = surface + at;
    for (size_t i = 0; i < kRun; ++i) {
        float facing = nx[i] * nx2[i] + ny[i] * ny2[i] + nz[i] * nz2[i];
        facing = facing > 0 ? facing : 0;
        facing *= facing;
        facing *= facing;
        facing *= facing;
        facing *= facing;
        facing *= facing;
        const float apart =
            (depth2[i] - depth[i] - along_x[i] * right - along_y[i] * below) * here.by_depth[i];
        const float texture = albedo2[i] - albedo[i];
        const float bright = brightness(r[i], green[i], b[i]) - here.bright[i];
        const float unlike = (1 + apart * apart) * (1 + kOtherAlbedo * texture * texture) *
                             (1 + bright * bright * here.by_noise[i]);
        const float like = share * facing / unlike;
        const float weight = surface2[i] == surface[i] ? like : 0;
        sums.c[0][i] += weight * r[i];
        sums.c[1][i] += weight * green[i];
        sums.c[2][i] += weight * b[i];
        sums.c[3][i] += weight * a[i];
        sums.variance[i] += weight * weight * variance[i];
        sums.weight[i] += weight;
    }
}

void pass(const FilterGuide& g, const FilterColors& from, int step, ptrdiff_t stride,
          const FilterResult& to) {
    Here here;
    Sums sums;
    const float *r = from.c[0], *green = from.c[1], *b = from.c[2];
    for (size_t i = 0; i < kRun; ++i) {
        here.bright[i] = brightness(r[i], green[i], b[i]);
        here.by_noise[i] = kNoise / (from.variance[i] + kLeastVariance);
        const float depth = g.depth[i] < 0 ? -g.depth[i] : g.depth[i];
        here.by_depth[i] = kOtherDepth / (depth + 1e-30f);
        // The pixel itself.
        for (int k = 0; k < 4; ++k) sums.c[k][i] = 0.25f * from.c[k][i];
        sums.variance[i] = 0.0625f * from.variance[i];
        sums.weight[i] = 0.25f;
    }
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            if (x || y)
                add_tap(g, from, here, x && y ? 0.0625f : 0.125f, float(x * step), float(y * step),
                        (ptrdiff_t(y) * stride + x) * step, sums);
    for (size_t i = 0; i < kRun; ++i) {
        const float scale = 1 / sums.weight[i];
        // What is known for certain stays as it is.
        const bool noisy = from.variance[i] > 0;
        for (int k = 0; k < 4; ++k)
            to.c[k][i] = noisy ? sums.c[k][i] * scale : from.c[k][i];
        to.variance[i] = noisy ? sums.variance[i] * scale * scale : 0;
    }
}

bool exceeds(const float* numbers, float limit) {
    float most = 0;
    for (size_t i = 0; i < kRun; ++i) most = numbers[i] > most ? numbers[i] : most;
    return most > limit;
}

void smooth_variance(const uint32_t* surface, const float* variance, ptrdiff_t stride, float* to) {
    alignas(64) Row sum, count;
    for (size_t i = 0; i < kRun; ++i) sum[i] = count[i] = 0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ptrdiff_t at = y * stride + x;
            const float* other = variance + at;
            const uint32_t* surface2 = surface + at;
            for (size_t i = 0; i < kRun; ++i) {
                const float same = surface2[i] == surface[i] ? 1.0f : 0.0f;
                sum[i] += same * other[i];
                count[i] += same;
            }
        }
    for (size_t i = 0; i < kRun; ++i) to[i] = variance[i] > 0 ? sum[i] / count[i] : 0;
}

}  // namespace

extern const FilterKernels KINORA_KERNEL_TABLE(Filter);
const FilterKernels KINORA_KERNEL_TABLE(Filter) = {KINORA_INSTRUCTION_SET, pass, exceeds,
                                                   smooth_variance};

}  // namespace kinora
