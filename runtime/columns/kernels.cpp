// runtime/columns/kernels.cpp: chooses the kernels.
#include "runtime/columns/kernels.h"

namespace kinora {

const UsableColumnKernels& usable_column_kernels() {
    static const UsableColumnKernels usable = [] {
        UsableColumnKernels u{};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
            u.kernels[u.count++] = &kAvx512Columns;
        if (__builtin_cpu_supports("avx2")) u.kernels[u.count++] = &kAvx2Columns;
#endif
        u.kernels[u.count++] = &kPortableColumns;
        return u;
    }();
    return usable;
}

const ColumnKernels& column_kernels() {
    static const ColumnKernels& chosen = *usable_column_kernels().kernels[0];
    return chosen;
}

}  // namespace kinora
