// runtime/programs/list_scene.h: what is in a scene, for --list.
#pragma once

#include <string>

#include "runtime/scene.h"

namespace kinora {

// kind: "cameras", "clips", "materials", "shaders", "lights" or "all". Says also what was added.
std::string list_scene(const Scene& scene, const std::string& kind);

}  // namespace kinora
