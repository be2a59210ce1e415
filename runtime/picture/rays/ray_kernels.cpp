// runtime/picture/rays/ray_kernels.cpp: chooses the kernels.
#include "runtime/picture/rays/ray_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<RayKernels>& usable_ray_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Rays));
    return usable;
}

const RayKernels& ray_kernels() {
    static const RayKernels& widest = *usable_ray_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
