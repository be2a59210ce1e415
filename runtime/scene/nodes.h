// runtime/scene/nodes.h: the nodes of a scene, and what an animation can move.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/base/memory/shared_vector.h"
#include "runtime/scene/resources.h"

namespace kinora {

// One occurrence of a node definition; parents come first.
struct Node {
    uint32_t definition = kNone;
    uint32_t parent = kNone;
    bool can_move = false;  // it or an ancestor is animated
    bool hidden = false;    // it or an ancestor is
    bool chosen = true;     // its meshes are there (SceneDescription::only_chosen)
    dmat4 conversion{1.0};  // of the reference that brought it in
};

// What an animation can move; all else stands in every pose as in the first frame of each.
struct MovingParts {
    std::vector<uint32_t> nodes, shapes, surfaces;  // indices, in order
};

// With the description that defines them.
struct SceneNodes : SceneResources {
    SharedVector<Node> nodes;
    MovingParts moving;
};

}  // namespace kinora
