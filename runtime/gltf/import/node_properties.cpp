// runtime/gltf/import/node_properties.cpp: what channels write of a node.
#include "runtime/gltf/import/node_properties.h"

namespace kinora {

std::vector<uint8_t> moving_properties(const tinygltf::Model& model) {
    std::vector<uint8_t> moving(model.nodes.size(), 0);
    for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            if (channel.target_node < 0 || size_t(channel.target_node) >= moving.size()) continue;
            uint8_t& moves = moving[size_t(channel.target_node)];
            if (channel.target_path == "translation") moves |= kMovesTranslation;
            if (channel.target_path == "rotation") moves |= kMovesRotation;
            if (channel.target_path == "scale") moves |= kMovesScale;
            if (channel.target_path == "weights") moves |= kMovesWeights;
        }
    return moving;
}

}  // namespace kinora
