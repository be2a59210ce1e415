// runtime/build/defaults.h: the lights of scenes that bring none (docs/format.md#cameras).
#pragma once

#include "runtime/description/scene_description.h"

namespace kinora {

// Three lights on a node below the camera's: a key light from over its left shoulder that casts
// shadows; a fill light that reaches all the camera sees, and a rim light from behind, both without
// shadows and highlights.
NodeDefinition default_light_node(std::vector<double>& values);
std::vector<LightDefinition> default_lights(std::vector<double>& values, Diagnostics& diagnostics);

}  // namespace kinora
