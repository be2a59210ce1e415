// runtime/scene/extent.h: where a scene lies, and how large it is.
#pragma once

#include "runtime/base/math.h"

namespace kinora {

struct SceneExtent {
    dvec3 origin{0.0};  // of "accel" space
    double size = 1;    // diagonal of the first frame's bounds
    dvec3 low{0.0}, high{0.0};
};

}  // namespace kinora
