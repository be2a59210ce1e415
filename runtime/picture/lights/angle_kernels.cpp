// runtime/picture/lights/angle_kernels.cpp: chooses the kernels.
#include "runtime/picture/lights/angle_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<AngleKernels>& usable_angle_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Angles));
    return usable;
}

const AngleKernels& angle_kernels() {
    static const AngleKernels& widest = *usable_angle_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
