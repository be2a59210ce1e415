// raytrace/points/points.cpp: chooses the kernels.
#include "raytrace/points/points.h"

#include "runtime/base/choose_kernels.h"

namespace kinora::raytrace {

const UsableKernels<PointKernels>& usable_point_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Points));
    return usable;
}

const PointKernels& point_kernels() {
    static const PointKernels& widest = *usable_point_kernels().kernels[0];
    return widest;
}

}  // namespace kinora::raytrace
