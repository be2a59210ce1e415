// runtime/scene/build/cameras.h: the cameras of a scene, and the one it is seen by.
#pragma once

#include "runtime/scene/build/shapes/node_tree.h"

namespace kinora {

struct Scene;

// Every occurrence of a camera. Writes Scene::cameras.
void add_cameras(Scene& scene, const NodeTree& tree);

// The one that the options name or describe; else the description's, else the first, if it sees
// something of the scene; else one that is added, and frames all. Writes Scene::camera, and cameras
// and added with it. The scene has its bounds. False after an error, which is a finding.
bool choose_camera(Scene& scene, NodeTree& tree, Diagnostics& diagnostics);

}  // namespace kinora
