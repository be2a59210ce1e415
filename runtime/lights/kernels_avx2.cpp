// runtime/lights/kernels_avx2.cpp: the kernels for AVX2.
#include "runtime/lights/kernels_p.h"

namespace kinora {

extern const LightKernels kAvx2Lights;
const LightKernels kAvx2Lights = {"avx2",        bounds,        turn_signs,
                                  darken_unseen, add_strengths, mark_weak};

}  // namespace kinora
