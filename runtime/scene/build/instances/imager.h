// runtime/scene/build/instances/imager.h: the shader instance that runs over the finished picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace kinora {

// Shaders of the camera's imager; else of the scene's. Maybe none.
const std::vector<ShaderUse>& imagers_of(const Scene& scene);

// Writes Scene::imager and looks. The imager's parameters that are named like output parameters of
// surfaces are read from the planes that these fill.
void add_imager(Scene& scene, std::span<const std::string> outputs);

}  // namespace kinora
