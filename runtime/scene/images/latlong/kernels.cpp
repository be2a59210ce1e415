// runtime/scene/images/latlong/kernels.cpp: chooses the kernels.
#include "runtime/scene/images/latlong/kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<LatlongKernels>& usable_latlong_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Latlong));
    return usable;
}

const LatlongKernels& latlong_kernels() {
    static const LatlongKernels& widest = *usable_latlong_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
