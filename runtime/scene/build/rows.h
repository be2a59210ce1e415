// runtime/scene/build/rows.h: the ray tracer's rows.
#pragma once

#include "runtime/scene/scene.h"

namespace kinora {

// Writes Scene::geometry, one row a surface, and the shapes' spans of what is traced. Shapes and
// instances are complete.
void set_rows(Scene& scene);

}  // namespace kinora
