// runtime/scene/gltf/import/node_tree.h: the nodes that a scene reaches, as trees.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/gltf/file/report.h"

namespace kinora {

struct GltfNodeTree {
    std::vector<int> roots;                       // as the scene lists them; -1: no node
    std::vector<bool> shown;                      // per node: the scene reaches it
    std::vector<std::vector<uint32_t>> children;  // per node, each with one parent
};

// The number of the scene that is shown; the model has one.
size_t shown_scene(const tinygltf::Model& model);

// Of the model's scene, or of all nodes without a parent where there is no scene.
GltfNodeTree read_node_tree(const tinygltf::Model& model, GltfReport& report);

}  // namespace kinora
