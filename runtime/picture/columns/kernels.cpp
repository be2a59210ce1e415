// runtime/picture/columns/kernels.cpp: chooses the kernels.
#include "runtime/picture/columns/kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<ColumnKernels>& usable_column_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Columns));
    return usable;
}

const ColumnKernels& column_kernels() {
    static const ColumnKernels& widest = *usable_column_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
