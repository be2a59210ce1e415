// runtime/base/choose_kernels.h: which tables of kernels this CPU can run.
#pragma once

#include <type_traits>

#include "runtime/base/kernel_table.h"

namespace kinora {

// Null: not on this architecture.
template <class Kernels>
UsableKernels<Kernels> choose_kernels(std::type_identity_t<const Kernels*> avx512,
                                      std::type_identity_t<const Kernels*> avx2,
                                      const Kernels* portable) {
    UsableKernels<Kernels> usable{};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        usable.kernels[usable.count++] = avx512;
    if (__builtin_cpu_supports("avx2")) usable.kernels[usable.count++] = avx2;
#else
    static_cast<void>(avx512), static_cast<void>(avx2);
#endif
    usable.kernels[usable.count++] = portable;
    return usable;
}

}  // namespace kinora

// The arguments of choose_kernels() for the tables of a name.
#if defined(__x86_64__)
#define KINORA_ALL_TABLES(name) &kAvx512##name, &kAvx2##name, &kPortable##name
#else
#define KINORA_ALL_TABLES(name) nullptr, nullptr, &kPortable##name
#endif
