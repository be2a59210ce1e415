// runtime/programs/validate/scene_walk.h: every occurrence of a node in the visual scene, instances
// unrolled.
#pragma once

#include <vector>

#include "collada/scene/scene.h"
#include "runtime/base/math.h"

namespace kinora {

// The node's own matrix at rest.
dmat4 rest_matrix(const collada::Node& node);

struct PlacedNode {
    uint32_t node;  // index into scene.nodes
    dmat4 world;    // at rest
};

// In document order, parents first. The reader has bounded their number.
std::vector<PlacedNode> placed_nodes(const collada::SceneData& scene);

}  // namespace kinora
