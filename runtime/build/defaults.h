// runtime/build/defaults.h: the lights of scenes that bring none (docs/format.md#cameras).
#pragma once

#include "runtime/description/scene_description.h"

namespace kinora {

// A distant light from over the camera's left shoulder: a node below the camera's, and what hangs
// there; an ambient light of 0.15.
NodeDefinition default_light_node(std::vector<double>& values);
LightDefinition default_distant_light(Diagnostics& diagnostics);
LightDefinition default_ambient_light(std::vector<double>& values, Diagnostics& diagnostics);

}  // namespace kinora
