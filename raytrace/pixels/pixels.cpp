// raytrace/pixels/pixels.cpp: chooses the kernels, and what all pixels share of a sample.
#include "raytrace/pixels/pixels.h"

#include "raytrace/random/bits.h"
#include "runtime/base/choose_kernels.h"

namespace kinora::raytrace {

const UsableKernels<PixelKernels>& usable_pixel_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Pixels));
    return usable;
}

const PixelKernels& pixel_kernels() {
    static const PixelKernels& widest = *usable_pixel_kernels().kernels[0];
    return widest;
}

SampleBits sample_bits(uint32_t sample) {
    return {sample, sobol_second_reversed(sample)};
}

}  // namespace kinora::raytrace
