// raytrace/pixels/pixels_p.h: the kernels of pixels.h in plain C++. The compiler makes vectors of
// the loops, as wide as the file that includes this is compiled for. Every operation is exact or
// rounds once (no contraction), so all widths give the same bits.
//
// Directions are found in double and rounded once: neighbouring rays of a camera with a field of
// view of 0.001 degrees differ in the last bits of a float.
#pragma once

#include "raytrace/pixels/pixels.h"
#include "raytrace/random/bits.h"
#include "runtime/base/kernel_math.h"

#define KINORA_INLINE __attribute__((always_inline)) inline

namespace kinora::raytrace {
namespace {

void scrambles(const PixelSet& pixels, uint32_t seed) {
    const uint32_t x0 = pixels.x0, y0 = pixels.y0;
    const uint32_t *x = pixels.x, *y = pixels.y;
    uint32_t *first = pixels.scramble[0], *second = pixels.scramble[1];
#pragma GCC ivdep
    for (size_t i = 0; i < pixels.count; ++i) {
        const uint32_t own = hash(x0 + x[i], y0 + y[i], seed);
        first[i] = first_scramble(own);
        second[i] = second_scramble(own);
    }
}

// A block of rays: so many that what is between the loops below stays in the nearest cache.
constexpr size_t kBlock = 64;
constexpr size_t kWidest = 16;  // what is stored at once, even behind a block's end

// Where a sample of the pixels lies from the picture's centre along one axis, without a filter.
void centres(const uint32_t* pixel, uint32_t first, double centre, size_t count, double* at) {
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) at[i] = (double(int32_t(first + pixel[i])) + 0.5) - centre;
}

// The same with a filter's offsets for 32 bits of a number in [0, 1). Conversions are of signed
// numbers: those of unsigned ones are slow before AVX-512.
void filtered(const FilterTable& filter, const uint32_t* bits, const uint32_t* scramble,
              const uint32_t* pixel, uint32_t first, double centre, size_t count, double* at) {
    constexpr uint32_t kShift = 22;
    static_assert(kFilterCells == 1u << (32 - kShift));
    if (filter.linear) {
        const FilterTable::Cell cell = filter.cells[0];
#pragma GCC ivdep
        for (size_t i = 0; i < count; ++i) {
            const uint32_t u = owen_scramble_reversed(bits[i], scramble[i]) ^ 0x80000000u;
            const double cells = (double(int32_t(u)) + 0x1p31) * (1.0 / (1u << kShift));
            const double middle = double(int32_t(first + pixel[i])) + 0.5;
            at[i] = (middle + (cell.value + cell.step * cells)) - centre;
        }
        return;
    }
    uint32_t u[kBlock];
    double value[kBlock], step[kBlock];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) u[i] = owen_scramble_reversed(bits[i], scramble[i]);
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
template <bool kClip, bool kSpread>
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
        [[maybe_unused]] const double back_x = along_x * cube, back_y = along_y * cube;
        for (int k = 0; k < 3; ++k) {
            const double v = c.forward[k] + (c.dx[k] * across[i] + c.dy[k] * down[i]);
            out.dir[k][i] = float(v * inverse);
            if constexpr (kSpread) {
                out.ddir_dx[k][i] = float(c.dx[k] * inverse - v * back_x);
                out.ddir_dy[k][i] = float(c.dy[k] * inverse - v * back_y);
            }
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

KINORA_INLINE PixelRays rays_from(const PixelRays& all, size_t first) {
    PixelRays rays = all;
    for (int k = 0; k < 3; ++k) {
        rays.org[k] += first, rays.first_org[k] += first, rays.dir[k] += first;
        rays.ddir_dx[k] += first, rays.ddir_dy[k] += first;
    }
    rays.tnear += first, rays.tfar += first;
    rays.pixel_x += first, rays.pixel_y += first, rays.sample += first;
    return rays;
}

// Numbers of pixels, each n times; at `to` there is room for kWidest more.
KINORA_INLINE const uint32_t* repeated(const uint32_t* of_pixel, size_t pixels, size_t n,
                                       uint32_t* to) {
    if (n == 1) return of_pixel;
    for (size_t p = 0; p < pixels; ++p)
        for (size_t s = 0; s < n; s += kWidest)
            for (size_t i = 0; i < kWidest; ++i) to[p * n + s + i] = of_pixel[p];
    return to;
}

using Fill = void (*)(const PixelView&, size_t, const double*, const double*, const PixelRays&);
KINORA_INLINE Fill choose_fill(const PixelView& view) {
    if (view.orthographic) return view.clip ? orthographic<true> : orthographic<false>;
    if (view.without_spread)
        return view.clip ? perspective<true, false> : perspective<false, false>;
    return view.clip ? perspective<true, true> : perspective<false, true>;
}

// Rays of up to kBlock samples of each pixel: as many pixels a block as fit.
void rays_of(const PixelView& view, const PixelSet& pixels, const SampleBits* samples, size_t n,
             const FilterTable* filter, const PixelRays& to, size_t rays_a_pixel) {
    const Fill fill = choose_fill(view);
    const size_t whole = n == rays_a_pixel ? kBlock / n : 1;  // pixels
    uint32_t index[kBlock], sobol_reversed[kBlock];
    for (size_t i = 0; i < whole * n; ++i) {
        index[i] = samples[i % n].index;
        sobol_reversed[i] = samples[i % n].sobol_reversed;
    }
    uint32_t columns[4][kBlock + kWidest];
    double across[kBlock], down[kBlock];
    for (size_t first = 0; first < pixels.count; first += whole) {
        const size_t left = pixels.count - first, some = left < whole ? left : whole;
        const size_t count = some * n;
        const uint32_t* x = repeated(pixels.x + first, some, n, columns[0]);
        const uint32_t* y = repeated(pixels.y + first, some, n, columns[1]);
        if (filter) {
            filtered(*filter, index, repeated(pixels.scramble[0] + first, some, n, columns[2]), x,
                     pixels.x0, view.centre_x, count, across);
            filtered(*filter, sobol_reversed,
                     repeated(pixels.scramble[1] + first, some, n, columns[3]), y, pixels.y0,
                     view.centre_y, count, down);
        } else {
            centres(x, pixels.x0, view.centre_x, count, across);
            centres(y, pixels.y0, view.centre_y, count, down);
        }
        const PixelRays out = rays_from(to, first * rays_a_pixel);
        fill(view, count, across, down, out);
        for (size_t i = 0; i < count; ++i) {
            out.pixel_x[i] = pixels.x0 + x[i];
            out.pixel_y[i] = pixels.y0 + y[i];
            out.sample[i] = index[i];
        }
    }
}

void rays(const PixelView& view, const PixelSet& pixels, const SampleBits* samples, size_t n,
          const FilterTable* filter, const PixelRays& to) {
    for (size_t first = 0; first < n; first += kBlock) {
        const size_t some = n - first < kBlock ? n - first : kBlock;
        rays_of(view, pixels, samples + first, some, filter, rays_from(to, first), n);
    }
}

using FourDoubles = double __attribute__((vector_size(32)));

// Of two numbers the first where the mask is all ones, the other where it is 0.
KINORA_INLINE float either(uint32_t mask, float a, float b) {
    return __builtin_bit_cast(float, (__builtin_bit_cast(uint32_t, a) & mask) |
                                         (__builtin_bit_cast(uint32_t, b) & ~mask));
}

uint32_t lay(const LaidHits& hits, float least, float* const color[3], float* const through[3]) {
    alignas(64) float rest[3][kLaid], onward[kLaid];
    __builtin_memcpy(onward, hits.onward, sizeof(onward));
    for (int c = 0; c < 3; ++c) {
        const float *Ci = hits.Ci[c], *Oi = hits.Oi[c], *before = through[c];
        float* sum = color[c];
#pragma GCC ivdep
        for (size_t i = 0; i < kLaid; ++i) {
            const float left = before[i], o = Oi[i];
            // As std::clamp has it: NaN stays.
            const float above = either(0u - uint32_t(o < 0), 0, o);
            const float stopped = either(0u - uint32_t(1 < above), 1, above);
            sum[i] += left * Ci[i];
            rest[c][i] = left * ((1.0f - stopped) * onward[i]);
        }
        __builtin_memcpy(through[c], rest[c], sizeof(rest[c]));
    }
    alignas(64) uint32_t open[kLaid];
    for (size_t i = 0; i < kLaid; ++i) {
        const float x = rest[0][i], y = rest[1][i], z = rest[2][i];
        const float xy = x < y ? y : x, most = xy < z ? z : xy;
        open[i] = uint32_t(most > least) << i;
    }
    uint32_t all = 0;
    for (size_t i = 0; i < kLaid; ++i) all |= open[i];
    return all;
}

bool finite(const float* const* columns, size_t count, size_t first) {
    float zero[kLaid] = {};  // NaN if anything is not finite
    for (size_t c = 0; c < count; ++c) {
        const float* v = columns[c] + first;
        for (size_t i = 0; i < kLaid; ++i) zero[i] += v[i] * 0.0f;
    }
    uint32_t good = 1;
    for (size_t i = 0; i < kLaid; ++i) good &= uint32_t(zero[i] == 0);
    return good != 0;
}

KINORA_INLINE void load(const float* from, size_t count, FourDoubles& to) {
    FourFloats floats{};
    if (count == 4)
        __builtin_memcpy(&floats, from, sizeof(floats));
    else
        for (size_t i = 0; i < count; ++i) floats[i] = from[i];
    to = __builtin_convertvector(floats, FourDoubles);
}

// What each of up to four samples adds: colour and coverage.
template <bool kBackground>
KINORA_INLINE void shown(const float* const color[3], const float* const through[3],
                         const float* background, size_t first, size_t count,
                         FourDoubles (&of)[4]) {
    FourDoubles part[4], t[3];
    for (int k = 0; k < 3; ++k) {
        load(color[k] + first, count, part[k]);
        load(through[k] + first, count, t[k]);
        if constexpr (kBackground) part[k] += t[k] * double(background[k]);
    }
    if constexpr (kBackground)
        part[3] = FourDoubles{1, 1, 1, 1};
    else
        part[3] = ((1.0 - t[0]) * (1.0 / 3) + (1.0 - t[1]) * (1.0 / 3)) + (1.0 - t[2]) * (1.0 / 3);
    const FourDoubles a = __builtin_shufflevector(part[0], part[1], 0, 4, 2, 6),
                      b = __builtin_shufflevector(part[0], part[1], 1, 5, 3, 7),
                      c = __builtin_shufflevector(part[2], part[3], 0, 4, 2, 6),
                      d = __builtin_shufflevector(part[2], part[3], 1, 5, 3, 7);
    of[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    of[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    of[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    of[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// Samples in fours, and the sums of a pixel in one register where each four are of one pixel.
template <bool kBackground>
void add_samples(size_t pixels, size_t n, const float* const color[3],
                 const float* const through[3], const float* background, double* sums) {
    const bool one_pixel = n % 4 == 0;
    size_t pixel = 0, sample = 0;
    FourDoubles sum, of[4];
    __builtin_memcpy(&sum, sums, sizeof(sum));
    for (size_t first = 0; first < pixels * n; first += 4) {
        const size_t left = pixels * n - first, count = left < 4 ? left : 4;
        if (count == 4)
            shown<kBackground>(color, through, background, first, 4, of);
        else
            shown<kBackground>(color, through, background, first, count, of);
        if (one_pixel && sample + 4 < n) {
            for (int j = 0; j < 4; ++j) sum += of[j];
            sample += 4;
            continue;
        }
        for (size_t j = 0; j < count; ++j) {
            sum += of[j];
            if (++sample < n) continue;
            sample = 0;
            __builtin_memcpy(sums + 4 * pixel, &sum, sizeof(sum));
            if (++pixel < pixels) __builtin_memcpy(&sum, sums + 4 * pixel, sizeof(sum));
        }
    }
}

void add(size_t pixels, size_t n, const float* const color[3], const float* const through[3],
         const float* background, double* sums) {
    (background ? add_samples<true> : add_samples<false>)(pixels, n, color, through, background,
                                                          sums);
}

}  // namespace

extern const PixelKernels KINORA_KERNEL_TABLE(Pixels);
const PixelKernels KINORA_KERNEL_TABLE(Pixels) = {KINORA_INSTRUCTION_SET, scrambles, rays,
                                                  finite, lay, add};

}  // namespace kinora::raytrace
