// runtime/lights/kernels.cpp: chooses the kernels.
#include "runtime/lights/kernels.h"

namespace kinora {

const UsableLightKernels& usable_light_kernels() {
    static const UsableLightKernels usable = [] {
        UsableLightKernels u{};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
            u.kernels[u.count++] = &kAvx512Lights;
        if (__builtin_cpu_supports("avx2")) u.kernels[u.count++] = &kAvx2Lights;
#endif
        u.kernels[u.count++] = &kPortableLights;
        return u;
    }();
    return usable;
}

const LightKernels& light_kernels() {
    static const LightKernels& chosen = *usable_light_kernels().kernels[0];
    return chosen;
}

}  // namespace kinora
