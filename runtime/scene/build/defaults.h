// runtime/scene/build/defaults.h: the lights of scenes that bring none, and the world of Blender's
// (docs/lights.md#defaults).
#pragma once

#include "runtime/scene/description/default_lights.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Three lights on a node below the camera's: a key light from over its left shoulder that casts
// shadows; a fill light that reaches all the camera sees, and a rim light from behind, both without
// shadows and highlights. Behind them kGreyWorld, for what Blender's lamps leave dark.
inline constexpr const char* kGreyWorldShader = "grey_world";
inline constexpr float kGreyWorldLight = 0.05f;  // the color of Blender's world, if nobody sets it
NodeDefinition default_light_node(std::vector<double>& values);
std::vector<LightDefinition> default_lights(std::vector<double>& values);

}  // namespace kinora
