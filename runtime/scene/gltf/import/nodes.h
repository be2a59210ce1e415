// runtime/scene/gltf/import/nodes.h: glTF's nodes with what hangs on them.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/gltf/import/materials.h"
#include "runtime/scene/gltf/import/morphs.h"
#include "runtime/scene/gltf/import/node_properties.h"
#include "runtime/scene/gltf/import/node_tree.h"
#include "runtime/scene/gltf/import/skins.h"

namespace kinora {

class NodeImporter {
  public:
    // `moving` is moving_properties(model); `axes_node` (-1: none) stands for the axes and the unit
    // of the world, and its transform is left off.
    NodeImporter(const tinygltf::Model& model, const GltfNodeTree& tree,
                 const std::vector<uint8_t>& moving, int axes_node,
                 const MaterialImporter& materials, MorphImporter& morphs, SkinImporter& skins,
                 GltfReport& report, SceneDescription& out);

    void import_nodes(UniqueIds& ids);

    const std::vector<NodeSlots>& slots() const { return slots_; }

  private:
    void import_transforms(uint32_t node);
    bool usable(const std::vector<double>& numbers, size_t count, uint32_t node, const char* name);
    bool usable_matrix(uint32_t node);
    void import_visibility(uint32_t node);
    void import_content(uint32_t node);
    MeshUse mesh_use(uint32_t node);
    void report_missing_sets(uint32_t mesh, const PrimitiveGroup& group, const MaterialUse& use);

    const tinygltf::Model& model_;
    const GltfNodeTree& tree_;
    const std::vector<uint8_t>& moving_;
    int axes_node_;
    const MaterialImporter& materials_;
    MorphImporter& morphs_;
    SkinImporter& skins_;
    GltfReport& report_;
    SceneDescription& out_;
    std::vector<NodeSlots> slots_;                       // per node
    std::set<std::pair<uint32_t, uint32_t>> told_sets_;  // of a mesh and a material
};

}  // namespace kinora
