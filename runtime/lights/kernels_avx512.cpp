// runtime/lights/kernels_avx512.cpp: the kernels for AVX-512.
#include "runtime/lights/kernels_p.h"

namespace kinora {

extern const LightKernels kAvx512Lights;
const LightKernels kAvx512Lights = {"avx512",      bounds,        turn_signs,
                                    darken_unseen, add_strengths, mark_weak};

}  // namespace kinora
