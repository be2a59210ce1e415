// runtime/scene/build/shapes/node_tree.h: node definitions unrolled into the nodes of a scene.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"

namespace kinora {

// Adds a node that no file wrote and that nothing moves but what is above it. It stands as its
// parent does.
uint32_t add_node(SceneNodes& scene, Pose& start, NodeDefinition definition, uint32_t parent);

// Writes Scene::nodes and those of Scene::start. A definition that several nodes refer to occurs
// several times.
class NodeTree {
  public:
    // Unrolls the description's roots. Matrices are not set: evaluate_anew.
    NodeTree(SceneNodes& scene, Pose& start);

    // A node that no file wrote; the scene stands at its start time afterwards.
    uint32_t add(NodeDefinition definition, uint32_t parent);

    // The occurrence of a node definition that is nearest to node `from` in the tree: joints of an
    // instanced character belong to its own instance. kNone: there is none.
    uint32_t nearest_occurrence(uint32_t definition, uint32_t from) const;

    // The node itself, or the one of the file that it stands below.
    uint32_t named(uint32_t node) const;
    uint32_t parent(uint32_t node) const { return scene_.nodes[node].parent; }
    const NodeDefinition& definition(uint32_t node) const;

  private:
    void unroll(uint32_t definition, uint32_t parent, const dmat4& conversion);

    SceneNodes& scene_;
    Pose& start_;
    std::vector<bool> definition_moves_;
    std::map<uint32_t, uint32_t> first_occurrence_;  // node by definition
};

}  // namespace kinora
