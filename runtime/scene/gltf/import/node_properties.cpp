// runtime/scene/gltf/import/node_properties.cpp: what channels write of a node.
#include "runtime/scene/gltf/import/node_properties.h"

#include "runtime/scene/gltf/pointers/channel_target.h"

namespace kinora {

std::vector<uint8_t> moving_properties(const tinygltf::Model& model) {
    std::vector<uint8_t> moving(model.nodes.size(), 0);
    for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            const ChannelTarget target = target_of(channel);
            if (target.node < 0 || size_t(target.node) >= moving.size()) continue;
            uint8_t& moves = moving[size_t(target.node)];
            if (target.path == "translation") moves |= kMovesTranslation;
            if (target.path == "rotation") moves |= kMovesRotation;
            if (target.path == "scale") moves |= kMovesScale;
            if (target.path == "weights") moves |= kMovesWeights;
        }
    return moving;
}

}  // namespace kinora
