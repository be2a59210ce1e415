// runtime/rays/ray_kernels_avx512.cpp: the kernels in AVX-512.
#include "runtime/rays/ray_kernels_p.h"

namespace kinora {
extern const RayKernels kAvx512Rays;
const RayKernels kAvx512Rays = {"avx512", directions, leave};
}  // namespace kinora
