// runtime/rays/ray_kernels.cpp: which instruction set is used.
#include "runtime/rays/ray_kernels.h"

namespace kinora {

extern const RayKernels kPortableRays;
#if defined(__x86_64__)
extern const RayKernels kAvx2Rays, kAvx512Rays;
#endif

std::span<const RayKernels* const> all_ray_kernels() {
#if defined(__x86_64__)
    static const RayKernels* const all[] = {&kPortableRays, &kAvx2Rays, &kAvx512Rays};
    static const size_t count = [] {
        if (!__builtin_cpu_supports("avx2")) return size_t(1);
        bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
        return wide ? size_t(3) : size_t(2);
    }();
    return {all, count};
#else
    static const RayKernels* const all[] = {&kPortableRays};
    return all;
#endif
}

const RayKernels& ray_kernels() {
    static const RayKernels& best = *all_ray_kernels().back();
    return best;
}

}  // namespace kinora
