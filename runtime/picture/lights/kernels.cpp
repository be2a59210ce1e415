// runtime/picture/lights/kernels.cpp: chooses the kernels.
#include "runtime/picture/lights/kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<LightKernels>& usable_light_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Lights));
    return usable;
}

const LightKernels& light_kernels() {
    static const LightKernels& widest = *usable_light_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
