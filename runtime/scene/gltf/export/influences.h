// runtime/scene/gltf/export/influences.h: the joints of vertices as glTF has them.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct JointInfluence {
    uint32_t joint;
    float weight;
};

// Of each of these positions: all influences, the strongest first, each joint once, their weights
// adding up to 1. What a skin has no joint for follows the joint after its last.
std::vector<std::vector<JointInfluence>> vertex_influences(const SkinDefinition& skin,
                                                           const std::vector<uint32_t>& positions);

}  // namespace kinora
