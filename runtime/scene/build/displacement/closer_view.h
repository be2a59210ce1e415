// runtime/scene/build/displacement/closer_view.h: a view that displaced meshes are to be fine
// enough for, beside those of the range played.
#pragma once

#include <optional>

#include "raytrace/camera.h"

namespace kinora {

struct CloserView {
    double time = 0;                         // seconds: how deforming meshes stand
    std::optional<raytrace::Camera> camera;  // accel space; none: the scene's own at that time
};

}  // namespace kinora
