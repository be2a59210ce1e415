// runtime/scene/gltf/import/node_properties.h: what channels write of a node, and where it lies.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// Bits: properties that any channel writes.
enum NodeProperty : uint8_t {
    kMovesTranslation = 1,
    kMovesRotation = 2,
    kMovesScale = 4,
    kMovesWeights = 8
};

// Per node. Such properties get values even where the file has none.
std::vector<uint8_t> moving_properties(const tinygltf::Model& model);

// Where a node's translation, rotation and scale lie in values, and the morph with its weights;
// kNone: there is none.
struct NodeSlots {
    uint32_t translation = kNone, rotation = kNone, scale = kNone;
    uint32_t morph = kNone;
};

}  // namespace kinora
