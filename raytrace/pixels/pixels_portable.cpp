// raytrace/pixels/pixels_portable.cpp: the kernels for plain C++ (and NEON).
#include "raytrace/pixels/pixels_p.h"

namespace kinora::raytrace {

extern const PixelKernels kPortablePixels;
const PixelKernels kPortablePixels = {"portable", scrambles, rays, add};

}  // namespace kinora::raytrace
