// runtime/scene/build/rows.h: the ray tracer's rows.
#pragma once

#include "runtime/scene/shaders.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// Writes Scene::geometry, one row a surface, and the shapes' spans of what is traced. Shapes and
// instances are complete.
void set_rows(SceneShapes& scene, const SceneShaders& shaders);

}  // namespace kinora
