// runtime/build/cameras.h: the cameras of a scene, and the one it is seen by.
#pragma once

#include "runtime/build/shapes/node_tree.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Every occurrence of a camera; where there is none the default one, on a node of its own. Writes
// Scene::cameras and added. The scene has its bounds.
void add_cameras(Scene& scene, NodeTree& tree);

// The one that the options name, else the description's, else the first. Writes Scene::camera.
// False where there is none of that name; it has been reported.
bool choose_camera(Scene& scene, const NodeTree& tree, Diagnostics& diagnostics);

}  // namespace kinora
