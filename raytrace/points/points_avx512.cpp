// raytrace/points/points_avx512.cpp: the kernels for AVX-512.
#include "raytrace/points/points_p.h"

namespace kinora::raytrace {

extern const PointKernels kAvx512Points;
const PointKernels kAvx512Points = {"avx512",  interpolate, normalize, sound,
                                    footprint, leave,       sees_light};

}  // namespace kinora::raytrace
