// runtime/picture/lights/kernels_p.h: the kernels of kernels.h in plain C++. The compiler makes
// vectors of the loops, as wide as the file that includes this is compiled for. Every operation
// rounds once (no contraction), so all widths give the same bits.
#pragma once

#include "runtime/base/kernel_math.h"
#include "runtime/picture/lights/kernels.h"

namespace kinora {
namespace {

constexpr float kLargest = __FLT_MAX__;
// Sine of the angle about 90 degrees within which a kernel's rounding may decide.
constexpr float kUnseenMargin = 1e-4f, kMargin2 = kUnseenMargin * kUnseenMargin;
constexpr float kLeastSquare = 1e-30f;  // of a vector whose direction kernels see as we do

// The lesser (greater) of x and what is so far, lane by lane; so far where x is NaN.
__attribute__((always_inline)) inline FourFloats lesser(FourFloats x, FourFloats so_far) {
    return x < so_far ? x : so_far;
}
__attribute__((always_inline)) inline FourFloats greater(FourFloats x, FourFloats so_far) {
    return x > so_far ? x : so_far;
}

void bounds(const float* column, size_t count, float& low, float& high) {
    constexpr size_t kRows = 4;  // which do not wait for each other
    FourFloats least[kRows], most[kRows];
    for (size_t j = 0; j < kRows; ++j) {
        least[j] = FourFloats{} + __builtin_inff();
        most[j] = FourFloats{} - __builtin_inff();
    }
    size_t i = 0;
    for (; i + 4 * kRows <= count; i += 4 * kRows)
        for (size_t j = 0; j < kRows; ++j) {
            FourFloats x;
            __builtin_memcpy(&x, column + i + 4 * j, sizeof(x));
            least[j] = lesser(x, least[j]);
            most[j] = greater(x, most[j]);
        }
    for (; i < count; ++i) {
        const FourFloats x = FourFloats{} + column[i];
        least[0] = lesser(x, least[0]);
        most[0] = greater(x, most[0]);
    }
    for (size_t j = 1; j < kRows; ++j) {
        least[0] = lesser(least[j], least[0]);
        most[0] = greater(most[j], most[0]);
    }
    low = least[0][0];
    high = most[0][0];
    for (int lane = 1; lane < 4; ++lane) {
        low = least[0][lane] < low ? least[0][lane] : low;
        high = most[0][lane] > high ? most[0][lane] : high;
    }
}

// Bits of the cell along one axis, two places apart.
__attribute__((always_inline)) inline uint32_t cell_bits(float at) {
    const float above = at > 0 ? at : 0.0f, within = above < 7 ? above : 7.0f;
    const uint32_t x = uint32_t(int32_t(within));
    return (x & 1) | (x & 2) << 2 | (x & 4) << 4;
}

void cells(const float* const P[3], const float low[3], const float scale[3], size_t count,
           uint32_t* cell) {
    const float *x = P[0], *y = P[1], *z = P[2];
    const float x0 = low[0], y0 = low[1], z0 = low[2], sx = scale[0], sy = scale[1], sz = scale[2];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i)
        cell[i] = cell_bits((x[i] - x0) * sx) | cell_bits((y[i] - y0) * sy) << 1 |
                  cell_bits((z[i] - z0) * sz) << 2;
}

// 1 where the sign of a product of two vectors is sure, 0 where rounding may decide.
__attribute__((always_inline)) inline uint32_t is_sure(float product, float square_a,
                                                       float square_b) {
    const float p2 = product * product;
    return uint32_t(p2 >= kMargin2 * square_a * square_b) & uint32_t(p2 <= kLargest) &
           uint32_t(square_a > kLeastSquare) & uint32_t(square_b > kLeastSquare);
}

void turn_signs(const float* const V[3], const float* const I[3], size_t count, float* signs) {
    const float *vx = V[0], *vy = V[1], *vz = V[2], *ix = I[0], *iy = I[1], *iz = I[2];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const float product = vx[i] * ix[i] + vy[i] * iy[i] + vz[i] * iz[i];
        const float v2 = vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i];
        const float i2 = ix[i] * ix[i] + iy[i] * iy[i] + iz[i] * iz[i];
        const float against = __builtin_copysignf(1.0f, -product);
        signs[i] *= is_sure(product, v2, i2) ? against : -0.0f;
    }
}

// The largest component of a color. Not to be used where their sum is no number or endless.
struct Strength {
    float sum, most;
    uint32_t is_number() const { return sum <= kLargest; }
};
__attribute__((always_inline)) inline Strength strength_of(float red, float green, float blue) {
    const float r = __builtin_fabsf(red), g = __builtin_fabsf(green), b = __builtin_fabsf(blue);
    const float rg = r < g ? g : r;
    return {r + g + b, rg < b ? b : rg};
}

void darken_unseen(const float* const N[3], const float* const L[3], const float* along,
                   const float* against, size_t count, float* const Cl[3]) {
    const float *nx = N[0], *ny = N[1], *nz = N[2], *lx = L[0], *ly = L[1], *lz = L[2];
    float *r = Cl[0], *g = Cl[1], *b = Cl[2];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const float product = nx[i] * lx[i] + ny[i] * ly[i] + nz[i] * lz[i];
        const float n2 = nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i];
        const float l2 = lx[i] * lx[i] + ly[i] * ly[i] + lz[i] * lz[i];
        const uint32_t sign = __builtin_bit_cast(uint32_t, product) >> 31;
        const uint32_t unseen =
            ((1 - sign) & uint32_t(along[i] == 0)) | (sign & uint32_t(against[i] == 0));
        const float red = r[i], green = g[i], blue = b[i];
        const Strength light = strength_of(red, green, blue);
        const uint32_t dark =
            is_sure(product, n2, l2) & unseen & light.is_number() & uint32_t(light.most > 0);
        r[i] = dark ? 0.0f : red;
        g[i] = dark ? 0.0f : green;
        b[i] = dark ? 0.0f : blue;
    }
}

size_t choose(const float* const Cl[3], const float* lit, size_t count, uint32_t* chosen) {
    constexpr size_t kRow = 16;
    const float *r = Cl[0], *g = Cl[1], *b = Cl[2];
    uint32_t* to = chosen;
    size_t i = 0;
    for (; i + kRow <= count; i += kRow) {
        uint32_t sent[kRow];
        for (size_t j = 0; j < kRow; ++j) {
            uint32_t bits = 1;  // of an integer
            if (lit) __builtin_memcpy(&bits, lit + i + j, sizeof(bits));
            const uint32_t shines = uint32_t(!(r[i + j] == 0)) | uint32_t(!(g[i + j] == 0)) |
                                    uint32_t(!(b[i + j] == 0));
            sent[j] = (shines & uint32_t(bits != 0)) << j;
        }
        uint32_t all = 0;
        for (size_t j = 0; j < kRow; ++j) all |= sent[j];
        if (all == 0xffffu) {
            for (size_t j = 0; j < kRow; ++j) to[j] = uint32_t(i + j);
            to += kRow;
            continue;
        }
        for (; all; all &= all - 1) *to++ = uint32_t(i) + uint32_t(__builtin_ctz(all));
    }
    for (; i < count; ++i) {
        uint32_t bits = 1;
        if (lit) __builtin_memcpy(&bits, lit + i, sizeof(bits));
        *to = uint32_t(i);
        to += bits != 0 && !(r[i] == 0 && g[i] == 0 && b[i] == 0);
    }
    return size_t(to - chosen);
}

void add_strengths(const float* const Cl[3], float share, size_t count, float* limits) {
    const float *r = Cl[0], *g = Cl[1], *b = Cl[2];
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const Strength light = strength_of(r[i], g[i], b[i]);
        limits[i] += share * (light.is_number() ? light.most : 0.0f);
    }
}

bool mark_weak(const float* const Cl[3], const float* limits, size_t count, uint32_t* weak) {
    const float *r = Cl[0], *g = Cl[1], *b = Cl[2];
    uint32_t any = 0;
#pragma GCC ivdep
    for (size_t i = 0; i < count; ++i) {
        const Strength light = strength_of(r[i], g[i], b[i]);
        const uint32_t is_weak =
            light.is_number() & uint32_t(light.most > 0) & uint32_t(light.most <= limits[i]);
        weak[i] |= is_weak;
        any |= is_weak;
    }
    return any != 0;
}

}  // namespace

extern const LightKernels KINORA_KERNEL_TABLE(Lights) = {
    KINORA_INSTRUCTION_SET, bounds, cells,         turn_signs,
    darken_unseen,          choose, add_strengths, mark_weak};

}  // namespace kinora
