// runtime/player/denoise/kernels_p.h: the kernels of kernels.h in plain C++. The compiler makes
// vectors of the loops, as wide as the file that includes this is compiled for. Every operation
// rounds once and in the same order, so all widths give the same bits.
#pragma once

#include <utility>

#include "runtime/player/denoise/brightness_p.h"
#include "runtime/player/denoise/kernels.h"

namespace kinora {
namespace {

constexpr size_t kRun = kFilterRun;
using Row = float[kRun];

constexpr float kOtherDepth = 100;   // one over the share of a depth that planes may lie apart
constexpr float kOtherAlbedo = 400;  // by its square
constexpr float kNoise = 1 / 6.0f;   // one over the square of the deviations that noise has
constexpr float kLeastVariance = 1e-7f;
// The surface of a pixel that is known for certain: mixed with none, it stays as it is.
constexpr uint32_t kAlone = 0xfffffffd;

// A pixel's sums, which stay in registers.
struct Sums {
    float r, g, b, a, variance, weight;
};

// What does not depend on the other pixel.
struct Here {
    float nx, ny, nz, depth, along_x, along_y, albedo;
    float bright, by_noise, by_depth;
    uint32_t surface;
};

// Tap `number` of nine, row by row; the pixel itself is 4.
template <int number>
__attribute__((always_inline)) inline void add_tap(const FilterGuide& g, const FilterColors& from,
                                                   const Here& here, int step, ptrdiff_t stride,
                                                   size_t i, Sums& sums) {
    constexpr int x = number % 3 - 1, y = number / 3 - 1;
    constexpr float share = x && y ? 0.0625f : 0.125f;
    if (x == 0 && y == 0) return;
    const ptrdiff_t at = (y * stride + x) * step + ptrdiff_t(i);
    float facing = here.nx * g.N[0][at] + here.ny * g.N[1][at] + here.nz * g.N[2][at];
    facing = facing > 0 ? facing : 0;
    facing *= facing;
    facing *= facing;
    facing *= facing;
    facing *= facing;
    facing *= facing;
    const float right = float(x * step), below = float(y * step);
    const float apart =
        (g.depth[at] - here.depth - here.along_x * right - here.along_y * below) * here.by_depth;
    const float texture = g.albedo[at] - here.albedo;
    const float r = from.c[0][at], green = from.c[1][at], b = from.c[2][at];
    const float bright = brightness(r, green, b) - here.bright;
    const float unlike = (1 + apart * apart) * (1 + kOtherAlbedo * texture * texture) *
                         (1 + bright * bright * here.by_noise);
    const float like = share * facing / unlike;
    const float weight = g.surface[at] == here.surface ? like : 0;
    sums.r += weight * r;
    sums.g += weight * green;
    sums.b += weight * b;
    sums.a += weight * from.c[3][at];
    sums.variance += weight * weight * from.variance[at];
    sums.weight += weight;
}

template <int... number>
__attribute__((always_inline)) inline void add_taps(std::integer_sequence<int, number...>,
                                                    const FilterGuide& g, const FilterColors& from,
                                                    const Here& here, int step, ptrdiff_t stride,
                                                    size_t i, Sums& sums) {
    (add_tap<number>(g, from, here, step, stride, i, sums), ...);
}

void pass(const FilterGuide& guide, const FilterColors& colors, int step, ptrdiff_t stride,
          const FilterResult& result) {
    const FilterGuide g = guide;
    const FilterColors from = colors;
    const FilterResult to = result;
#pragma GCC ivdep
    for (size_t i = 0; i < kRun; ++i) {
        const float r = from.c[0][i], green = from.c[1][i], b = from.c[2][i], a = from.c[3][i],
                    variance = from.variance[i];
        const uint32_t surface = g.surface[i];
        const float depth = g.depth[i] < 0 ? -g.depth[i] : g.depth[i];
        const Here here{g.N[0][i],
                        g.N[1][i],
                        g.N[2][i],
                        g.depth[i],
                        g.slope[0][i],
                        g.slope[1][i],
                        g.albedo[i],
                        brightness(r, green, b),
                        kNoise / (variance + kLeastVariance),
                        kOtherDepth / (depth + 1e-30f),
                        variance > 0 ? surface : kAlone};
        Sums sums{0.25f * r, 0.25f * green, 0.25f * b, 0.25f * a, 0.0625f * variance, 0.25f};
        add_taps(std::make_integer_sequence<int, 9>(), g, from, here, step, stride, i, sums);
        const float scale = 1 / sums.weight;
        to.c[0][i] = sums.r * scale;
        to.c[1][i] = sums.g * scale;
        to.c[2][i] = sums.b * scale;
        to.c[3][i] = sums.a * scale;
        to.variance[i] = sums.variance * scale * scale;
    }
}

bool exceeds(const float* numbers, float limit) {
    // Unlike their largest, which each would have to wait for.
    int32_t any = 0;
    for (size_t i = 0; i < kRun; ++i) any |= numbers[i] > limit ? 1 : 0;
    return any != 0;
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
