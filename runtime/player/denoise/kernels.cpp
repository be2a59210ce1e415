// runtime/player/denoise/kernels.cpp: chooses the kernels.
#include "runtime/player/denoise/kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<FilterKernels>& usable_filter_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Filter));
    return usable;
}

const FilterKernels& filter_kernels() {
    static const FilterKernels& widest = *usable_filter_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
