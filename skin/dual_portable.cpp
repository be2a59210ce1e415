// skin/dual_portable.cpp: the kernel of dual quaternions for vectors of four floats: SSE2, NEON, 4
// vertices at a time.
#include "skin/dual_kernel_p.h"

namespace kinora::skin {

extern const DeformKernel kDualPortableKernel = make_dual_kernel<4>("portable");

}  // namespace kinora::skin
