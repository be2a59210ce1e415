// runtime/scene/build/environment.h: what lies around a scene becomes one of its lights.
#pragma once

#include "runtime/scene/build/shapes/node_tree.h"

namespace kinora {

struct Scene;

// Whether the scene has something around it that is not hidden.
bool has_environment(const SceneDescription& description);

// Its light, after the others. False after an error: its picture cannot be read.
bool add_environment(Scene& scene, NodeTree& tree, Diagnostics& diagnostics);

}  // namespace kinora
