// runtime/rays/ray_kernels_portable.cpp: the kernels in plain C++; NEON on AArch64.
#include "runtime/rays/ray_kernels_p.h"

namespace kinora {
extern const RayKernels kPortableRays;
const RayKernels kPortableRays = {"portable", directions, leave};
}  // namespace kinora
