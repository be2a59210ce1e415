// raytrace/pixels/pixels_avx512.cpp: the kernels for AVX-512.
#include "raytrace/pixels/pixels_p.h"

namespace kinora::raytrace {

extern const PixelKernels kAvx512Pixels;
const PixelKernels kAvx512Pixels = {"avx512", scrambles, rays, add};

}  // namespace kinora::raytrace
