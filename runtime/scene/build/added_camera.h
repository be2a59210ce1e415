// runtime/scene/build/added_camera.h: a camera that no file brought.
#pragma once

#include "runtime/scene/build/shapes/node_tree.h"
#include "runtime/scene/build/views.h"

namespace kinora {

struct Scene;

// Half of the picture's width over half of its height that scenes are framed for.
double wanted_aspect(const SceneOptions& options);

// Adds a camera on a node of its own, placed and moving as the options say, and makes it the
// scene's: from the view's direction, or their own place, around what is shown over the range
// played. Writes Scene::cameras, camera and added. False after an error, which is a finding.
bool add_camera(Scene& scene, NodeTree& tree, const ViewWord& view, Diagnostics& diagnostics);

// The first node of that path, id or name; kNone: there is none.
uint32_t find_node(const SceneNodes& scene, const NodeTree& tree, const std::string& wanted);
// "torso/head/eye", by ids.
std::string path_of(const NodeTree& tree, uint32_t node);

}  // namespace kinora
