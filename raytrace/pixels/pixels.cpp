// raytrace/pixels/pixels.cpp: chooses the kernels, and what all pixels share of a sample.
#include "raytrace/pixels/pixels.h"

namespace kinora::raytrace {

const UsablePixelKernels& usable_pixel_kernels() {
    static const UsablePixelKernels usable = [] {
        UsablePixelKernels u{};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
            u.kernels[u.count++] = &kAvx512Pixels;
        if (__builtin_cpu_supports("avx2")) u.kernels[u.count++] = &kAvx2Pixels;
#endif
        u.kernels[u.count++] = &kPortablePixels;
        return u;
    }();
    return usable;
}

const PixelKernels& pixel_kernels() {
    return *usable_pixel_kernels().kernels[0];
}

// Sobol's second column by the Pascal matrix modulo 2 (raytrace/sampling.cpp), its bits reversed:
// column k is then what (1 + x)^k leaves of x^0, x^1, ..., so each is the one before xor its
// double.
SampleBits sample_bits(uint32_t sample) {
    SampleBits bits{sample, 0};
    uint32_t column = 1;
    for (uint32_t left = sample; left != 0; left >>= 1, column ^= column << 1)
        if (left & 1) bits.sobol_reversed ^= column;
    return bits;
}

}  // namespace kinora::raytrace
