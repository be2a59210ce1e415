// skin/dual_avx2.cpp: the kernel of dual quaternions for AVX2, 8 vertices at a time.
#include "skin/dual_kernel_p.h"

namespace kinora::skin {

extern const DeformKernel kDualAvx2Kernel = make_dual_kernel<8>("avx2");

}  // namespace kinora::skin
