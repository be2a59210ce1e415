// raytrace/points/points_avx2.cpp: the kernels for AVX2.
#include "raytrace/points/points_p.h"

namespace kinora::raytrace {

extern const PointKernels kAvx2Points;
const PointKernels kAvx2Points = {"avx2",    interpolate, normalize, sound,
                                  footprint, leave,       sees_light};

}  // namespace kinora::raytrace
