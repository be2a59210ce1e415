// runtime/build/defaults.h: the camera and lights of scenes that bring none
// (docs/format.md#cameras).
#pragma once

#include "runtime/build/shapes/bounds.h"
#include "runtime/description/scene_description.h"

namespace kinora {

// yfov 37, looking along (1, 0.6, 1) of the up-axis frame at the bounds, which fill the picture.
struct DefaultCamera {
    CameraDefinition camera;
    NodeDefinition node;
};
DefaultCamera default_camera(const Bounds& bounds, UpAxis up, std::vector<double>& values);

// Three lights on a node below the camera's: a key light from over its left shoulder that casts
// shadows; a fill light that reaches all the camera sees, and a rim light from behind, both without
// shadows and highlights.
NodeDefinition default_light_node(std::vector<double>& values);
std::vector<LightDefinition> default_lights(std::vector<double>& values, Diagnostics& diagnostics);

}  // namespace kinora
