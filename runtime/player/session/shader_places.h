// runtime/player/session/shader_places.h: the shaders of a scene that can be edited, by name.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// One shader, where the scene wears it. `id` is the material's for the surface that is seen, else
// "MATERIAL:displacement", "MATERIAL:surface" (one below), "light:LIGHT", "scene:imager",
// "CAMERA:imager" and so on; the second of a stack has a 2 behind it.
struct ShaderPlace {
    std::string id, name;
    std::string target;              // what override_param() calls the wearer
    const ShaderUse* use = nullptr;  // null: a material without a surface
};

// First what the materials show, in their order; then all others.
std::vector<ShaderPlace> shader_places(const SceneDescription& description);
// The others alone.
std::vector<ShaderPlace> further_places(const SceneDescription& description);

}  // namespace kinora
