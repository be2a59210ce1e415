// runtime/player/denoise/history_kernels.cpp: chooses the kernels.
#include "runtime/player/denoise/history_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<HistoryKernels>& usable_history_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(History));
    return usable;
}

const HistoryKernels& history_kernels() {
    static const HistoryKernels& widest = *usable_history_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
