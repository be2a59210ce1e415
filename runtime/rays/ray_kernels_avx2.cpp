// runtime/rays/ray_kernels_avx2.cpp: the kernels in AVX2.
#include "runtime/rays/ray_kernels_p.h"

namespace kinora {
extern const RayKernels kAvx2Rays;
const RayKernels kAvx2Rays = {"avx2", directions, leave};
}  // namespace kinora
