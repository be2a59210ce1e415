// raytrace/points/points_portable.cpp: the kernels for plain C++ (and NEON).
#include "raytrace/points/points_p.h"

namespace kinora::raytrace {

extern const PointKernels kPortablePoints;
const PointKernels kPortablePoints = {"portable", interpolate, normalize, sound,
                                      footprint,  leave,       sees_light};

}  // namespace kinora::raytrace
