// raytrace/pixels/pixels.cpp: chooses the kernels, and what all pixels share of a sample.
#include "raytrace/pixels/pixels.h"

#include "raytrace/random/bits.h"

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

SampleBits sample_bits(uint32_t sample) {
    return {sample, sobol_second_reversed(sample)};
}

}  // namespace kinora::raytrace
