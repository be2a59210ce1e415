// runtime/lights/kernels_portable.cpp: the kernels for any CPU.
#include "runtime/lights/kernels_p.h"

namespace kinora {

extern const LightKernels kPortableLights;
const LightKernels kPortableLights = {"portable",    bounds,        turn_signs,
                                      darken_unseen, add_strengths, mark_weak};

}  // namespace kinora
