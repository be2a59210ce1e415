// runtime/player/bytes/byte_kernels_p.h: the kernels of byte_kernels.h in plain C++; the compiler
// makes vectors of the loops.
#pragma once

#include "runtime/player/bytes/byte_kernels.h"

namespace kinora {
namespace {

constexpr size_t kRun = kByteRun;

// The bytes of one component, into that place of the pixels; it ends at the first and last step.
__attribute__((always_inline)) inline void look_up(const float* __restrict numbers,
                                                   const float* __restrict scale,
                                                   const int32_t* __restrict steps, int shift,
                                                   int32_t* __restrict pixels) {
    constexpr int32_t kLow = (1 << kStepShift) - 1;
    for (size_t k = 0; k < kRun; ++k) {
        float c = numbers[k] * scale[k];
        c = c > 0x1p-14f ? c : 0x1p-14f;
        c = c < 1.0f ? c : 1.0f;
        const int32_t bits = __builtin_bit_cast(int32_t, c);
        const int32_t step = steps[(bits >> kStepShift) - kFirstStep];
        pixels[k] |= ((step & 255) + int32_t((bits & kLow) >= step >> 8)) << shift;
    }
}

bool bytes(const float* __restrict rgba, const int32_t* __restrict steps,
           const int32_t* __restrict alphas, uint8_t* __restrict to) {
    constexpr int32_t kInfinite = 0x7f800000;
    float r[kRun], g[kRun], b[kRun], a[kRun], scale[kRun], whole[kRun];
    int32_t pixels[kRun], strange = 0;
    for (size_t k = 0; k < kRun; ++k) {
        r[k] = rgba[4 * k];
        g[k] = rgba[4 * k + 1];
        b[k] = rgba[4 * k + 2];
        a[k] = rgba[4 * k + 3];
    }
    for (size_t k = 0; k < kRun; ++k) {
        const float inverse = 1.0f / a[k];
        scale[k] = a[k] > 0 ? inverse : 1.0f;
        whole[k] = 1.0f;
        pixels[k] = 0;
        const float sum = r[k] + g[k] + b[k] + a[k];
        strange |= (__builtin_bit_cast(int32_t, sum) & kInfinite) == kInfinite ? 1 : 0;
    }
    if (strange) return false;
    look_up(r, scale, steps, 0, pixels);
    look_up(g, scale, steps, 8, pixels);
    look_up(b, scale, steps, 16, pixels);
    look_up(a, whole, alphas, 24, pixels);
    for (size_t k = 0; k < kRun; ++k)
        for (size_t c = 0; c < 4; ++c) to[4 * k + c] = uint8_t(pixels[k] >> (8 * c));
    return true;
}

}  // namespace

extern const ByteKernels KINORA_KERNEL_TABLE(Byte);
const ByteKernels KINORA_KERNEL_TABLE(Byte) = {KINORA_INSTRUCTION_SET, bytes};

}  // namespace kinora
