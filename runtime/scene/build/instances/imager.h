// runtime/scene/build/instances/imager.h: the shader instance that runs over the finished picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/camera.h"
#include "runtime/scene/shaders.h"

namespace kinora {

// Shaders of the camera's imager; else of the scene's. Maybe none.
const std::vector<ShaderUse>& imagers_of(const SceneDescription& description,
                                         const CameraSource& camera);

// Writes Scene::imager and looks. The imager's parameters that are named like output parameters of
// surfaces are read from the planes that these fill.
void add_imager(const SceneDescription& description, const CameraSource& camera,
                SceneShaders& scene, std::span<const std::string> outputs);

}  // namespace kinora
