// raytrace/pixels/pixels_avx2.cpp: the kernels for AVX2.
#include "raytrace/pixels/pixels_p.h"

namespace kinora::raytrace {

extern const PixelKernels kAvx2Pixels;
const PixelKernels kAvx2Pixels = {"avx2", scrambles, rays, add};

}  // namespace kinora::raytrace
