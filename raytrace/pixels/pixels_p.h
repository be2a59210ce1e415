// raytrace/pixels/pixels_p.h: the kernels of pixels.h in plain C++. The compiler makes vectors of
// the loops, as wide as the file that includes this is compiled for. Every operation is exact or
// rounds once (no contraction), so all widths give the same bits.
//
// Directions are found in double and rounded once: neighbouring rays of a camera with a field of
// view of 0.001 degrees differ in the last bits of a float.
#pragma once

#include "raytrace/pixels/pixels.h"

#define KINORA_INLINE __attribute__((always_inline)) inline

namespace kinora::raytrace {
namespace {

// raytrace/sampling.h has the originals.
constexpr uint32_t mix(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
constexpr uint32_t with(uint32_t b) {  // hash(a, b) = mix(a ^ with(b))
    return mix(b) + 0x9e3779b9u;
}

KINORA_INLINE uint32_t reverse_bits(uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// owen_scramble() of a number whose bits are reversed already.
KINORA_INLINE uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

void scrambles(const PixelSet& pixels, uint32_t seed) {
    constexpr uint32_t kFirst = with(0x68bc21ebu), kSecond = with(0x02e5be93u);
    const uint32_t of_frame = with(seed), x0 = pixels.x0, y0 = pixels.y0;
    const uint32_t *x = pixels.x, *y = pixels.y;
    uint32_t *first = pixels.scramble[0], *second = pixels.scramble[1];
#pragma GCC ivdep
    for (size_t i = 0; i < pixels.count; ++i) {
        const uint32_t own = mix(mix((x0 + x[i]) ^ with(y0 + y[i])) ^ of_frame);
        first[i] = mix(own ^ kFirst);
        second[i] = mix(own ^ kSecond);
    }
}

// A block of pixels: so many that what is between the loops below stays in the nearest cache.
constexpr size_t kBlock = 64;

// Where a sample of the pixels lies from the picture's centre along one axis, without a filter.
void centres(const uint32_t* pixel, uint32_t first, double centre, size_t count, double* at) {
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) at[i] = (double(int32_t(first + pixel[i])) + 0.5) - centre;
}

// The same with a filter's offsets for 32 bits of a number in [0, 1). Conversions are of signed
// numbers: those of unsigned ones are slow before AVX-512.
void filtered(const FilterTable& filter, uint32_t bits, const uint32_t* scramble,
              const uint32_t* pixel, uint32_t first, double centre, size_t count, double* at) {
    constexpr uint32_t kShift = 22;
    static_assert(kFilterCells == 1u << (32 - kShift));
    if (filter.linear) {
        const FilterTable::Cell cell = filter.cells[0];
#pragma GCC ivdep
        for (size_t i = 0; i < count; ++i) {
            const uint32_t u = scramble_reversed(bits, scramble[i]) ^ 0x80000000u;
            const double cells = (double(int32_t(u)) + 0x1p31) * (1.0 / (1u << kShift));
            const double middle = double(int32_t(first + pixel[i])) + 0.5;
            at[i] = (middle + (cell.value + cell.step * cells)) - centre;
        }
        return;
    }
    uint32_t u[kBlock];
    double value[kBlock], step[kBlock];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) u[i] = scramble_reversed(bits, scramble[i]);
    for (size_t i = 0; i < count; ++i) {
        const FilterTable::Cell cell = filter.cells[u[i] >> kShift];
        value[i] = cell.value;
        step[i] = cell.step;
    }
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const double part = double(int32_t(u[i] & ((1u << kShift) - 1))) * (1.0 / (1u << kShift));
        const double middle = double(int32_t(first + pixel[i])) + 0.5;
        at[i] = (middle + (value[i] + step[i] * part)) - centre;
    }
}

// Of `count` samples, `across` and `down` from the picture's centre.
template <bool kClip>
void perspective(const PixelView& view, size_t count, const double* across, const double* down,
                 const PixelRays& to) {
    const PixelView c = view;  // copies, which no store below can change
    const PixelRays out = to;
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        // v = forward + across dx + down dy, all three at right angles and |forward| = 1; its
        // unit vector's change is (dx - n (n . dx)) / |v|, and v . dx = across dx . dx.
        const double along_x = across[i] * c.dx_square, along_y = down[i] * c.dy_square;
        const double length = __builtin_sqrt(1.0 + (across[i] * along_x + down[i] * along_y));
        const double inverse = 1.0 / length, cube = inverse * inverse * inverse;
        const double back_x = along_x * cube, back_y = along_y * cube;
        for (int k = 0; k < 3; ++k) {
            const double v = c.forward[k] + (c.dx[k] * across[i] + c.dy[k] * down[i]);
            out.dir[k][i] = float(v * inverse);
            out.ddir_dx[k][i] = float(c.dx[k] * inverse - v * back_x);
            out.ddir_dy[k][i] = float(c.dy[k] * inverse - v * back_y);
        }
        if constexpr (kClip) {
            out.tnear[i] = float(c.znear * length);
            out.tfar[i] = float(c.zfar * length);
        }
    }
}

template <bool kClip>
void orthographic(const PixelView& view, size_t count, const double* across, const double* down,
                  const PixelRays& to) {
    const PixelView c = view;
    const PixelRays out = to;
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const float org = float(c.eye[k] + (c.dx[k] * across[i] + c.dy[k] * down[i]));
            out.org[k][i] = org;
            out.first_org[k][i] = org;
            out.dir[k][i] = float(c.forward[k]);
        }
        if constexpr (kClip) {
            out.tnear[i] = float(c.znear);
            out.tfar[i] = float(c.zfar);
        }
    }
}

KINORA_INLINE void advance(PixelRays& rays) {
    for (int k = 0; k < 3; ++k) {
        rays.org[k] += kBlock, rays.first_org[k] += kBlock, rays.dir[k] += kBlock;
        rays.ddir_dx[k] += kBlock, rays.ddir_dy[k] += kBlock;
    }
    rays.tnear += kBlock, rays.tfar += kBlock;
    rays.pixel_x += kBlock, rays.pixel_y += kBlock;
}

void rays(const PixelView& view, const PixelSet& pixels, const SampleBits& sample,
          const FilterTable* filter, const PixelRays& to) {
    const auto fill = view.orthographic ? (view.clip ? orthographic<true> : orthographic<false>)
                                        : (view.clip ? perspective<true> : perspective<false>);
    PixelRays out = to;
    for (size_t first = 0; first < pixels.count; first += kBlock) {
        const size_t left = pixels.count - first, count = left < kBlock ? left : kBlock;
        const uint32_t *x = pixels.x + first, *y = pixels.y + first;
        double across[kBlock], down[kBlock];
        if (filter) {
            filtered(*filter, sample.index, pixels.scramble[0] + first, x, pixels.x0, view.centre_x,
                     count, across);
            filtered(*filter, sample.sobol_reversed, pixels.scramble[1] + first, y, pixels.y0,
                     view.centre_y, count, down);
        } else {
            centres(x, pixels.x0, view.centre_x, count, across);
            centres(y, pixels.y0, view.centre_y, count, down);
        }
        fill(view, count, across, down, out);
        for (size_t i = 0; i < count; ++i) {
            out.pixel_x[i] = pixels.x0 + x[i];
            out.pixel_y[i] = pixels.y0 + y[i];
        }
        advance(out);
    }
}

template <bool kBackground>
void add_samples(size_t count, const float* const color[3], const float* const through[3],
                 const float* background, const PixelSums& to) {
    const PixelSums sums = to;
    const float *r = color[0], *g = color[1], *b = color[2];
    const float *tr = through[0], *tg = through[1], *tb = through[2];
    const double back[3] = {kBackground ? double(background[0]) : 0.0,
                            kBackground ? double(background[1]) : 0.0,
                            kBackground ? double(background[2]) : 0.0};
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const double t[3] = {double(tr[i]), double(tg[i]), double(tb[i])};
        double shown[3] = {double(r[i]), double(g[i]), double(b[i])};
        for (int k = 0; k < 3; ++k) {
            if constexpr (kBackground) shown[k] += t[k] * back[k];
            sums.color[k][i] += shown[k];
        }
        sums.coverage[i] += kBackground ? 1.0
                                        : ((1.0 - t[0]) * (1.0 / 3) + (1.0 - t[1]) * (1.0 / 3)) +
                                              (1.0 - t[2]) * (1.0 / 3);
    }
}

void add(size_t count, const float* const color[3], const float* const through[3],
         const float* background, const PixelSums& sums) {
    (background ? add_samples<true> : add_samples<false>)(count, color, through, background, sums);
}

}  // namespace
}  // namespace kinora::raytrace
