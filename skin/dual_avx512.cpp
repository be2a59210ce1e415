// skin/dual_avx512.cpp: the kernel of dual quaternions for AVX-512, 16 vertices at a time.
#include "skin/dual_kernel_p.h"

namespace kinora::skin {

extern const DeformKernel kDualAvx512Kernel = make_dual_kernel<16>("avx512");

}  // namespace kinora::skin
