// runtime/scene/build/area_lights.h: surfaces that shine.
#pragma once

#include <span>

#include "runtime/scene/build/shapes/surface_use.h"
#include "runtime/scene/lights.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// A light for each surface and LIGHT shader of its material. Whether there is any. Writes
// Scene::lights and the description's.
bool add_area_lights(SceneDescription& description, SceneShapes& shapes, SceneLights& scene,
                     std::span<const SurfaceUse> uses);

}  // namespace kinora
