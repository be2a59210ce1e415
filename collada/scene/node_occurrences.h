// collada/scene/node_occurrences.h: where the nodes of a scene occur, and the skins that they
// instance.
#pragma once

#include <unordered_map>
#include <vector>

#include "collada/scene/scene.h"
#include "runtime/base/skin_space.h"

namespace kinora::collada {

// A node definition by the first way that leads to it; parents come first.
struct NodeOccurrence {
    uint32_t node;
    uint32_t parent;            // an occurrence, or kNone
    dmat4 local, world, start;  // as the file leaves it, in the world, and there at the first keys
};

class NodeOccurrences {
  public:
    explicit NodeOccurrences(const SceneData& scene);  // which must outlive it

    const std::vector<NodeOccurrence>& all() const { return all_; }
    bool animated(uint32_t node) const { return started_.count(node) != 0; }

    struct SkinPoses {
        SkinPose rest, start;
        std::vector<RestJoint> moving;  // at rest, those that some vertex follows
    };
    // Of a skin that the node of an occurrence instances.
    SkinPoses skin_poses(uint32_t occurrence, const MeshInstance& mesh) const;

  private:
    void start(const Channel& channel);
    void walk(uint32_t root);

    const SceneData& scene_;
    const std::vector<Node>& nodes_;
    std::vector<NodeOccurrence> all_;
    std::vector<uint32_t> occurrence_of_;                           // by node definition
    std::unordered_map<uint32_t, std::vector<Transform>> started_;  // of nodes that channels move
};

}  // namespace kinora::collada
