// runtime/picture/lights/lamp_kernels.cpp: chooses the kernels of lamps.
#include "runtime/picture/lights/lamp_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<LampKernels>& usable_lamp_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Lamps));
    return usable;
}

const LampKernels& lamp_kernels() {
    static const LampKernels& widest = *usable_lamp_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
