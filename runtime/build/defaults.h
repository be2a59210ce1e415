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

// A distant light from over the camera's left shoulder: a node below the camera's, and what hangs
// there; an ambient light of 0.15.
NodeDefinition default_light_node(std::vector<double>& values);
LightDefinition default_distant_light(Diagnostics& diagnostics);
LightDefinition default_ambient_light(std::vector<double>& values, Diagnostics& diagnostics);

}  // namespace kinora
