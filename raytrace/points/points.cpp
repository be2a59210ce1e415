// raytrace/points/points.cpp: chooses the kernels.
#include "raytrace/points/points.h"

namespace kinora::raytrace {

const UsablePointKernels& usable_point_kernels() {
    static const UsablePointKernels usable = [] {
        UsablePointKernels u{};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
            u.kernels[u.count++] = &kAvx512Points;
        if (__builtin_cpu_supports("avx2")) u.kernels[u.count++] = &kAvx2Points;
#endif
        u.kernels[u.count++] = &kPortablePoints;
        return u;
    }();
    return usable;
}

const PointKernels& point_kernels() {
    static const PointKernels& chosen = *usable_point_kernels().kernels[0];
    return chosen;
}

}  // namespace kinora::raytrace
