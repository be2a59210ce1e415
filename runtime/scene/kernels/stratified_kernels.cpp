// runtime/scene/kernels/stratified_kernels.cpp: chooses the kernels.
#include "runtime/scene/kernels/stratified_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<StratifiedKernels>& usable_stratified_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Stratified));
    return usable;
}

const StratifiedKernels& stratified_kernels() {
    static const StratifiedKernels& widest = *usable_stratified_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
