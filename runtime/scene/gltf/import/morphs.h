// runtime/scene/gltf/import/morphs.h: glTF's morph targets as meshes of differences.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "runtime/scene/gltf/import/meshes.h"

namespace kinora {

class MorphImporter {
  public:
    MorphImporter(const tinygltf::Model& model, const MeshImporter& meshes,
                  AccessorReader& accessors, GltfReport& report, ByteBudget& budget,
                  SceneDescription& out);

    // Targets of all primitives of a mesh become meshes with its positions' count and groups.
    void import_targets(uint32_t mesh);

    // The morph of a mesh on a node, kNone where it has no targets. A node with weights of its own,
    // or whose weights move, has its own morph.
    uint32_t morph_of(uint32_t mesh, uint32_t node, bool weights_move);

  private:
    struct Target;  // one while it is read
    bool read_differences(const Target& target, uint32_t primitive, const char* name,
                          AccessorNumbers& out);
    void add_positions(const Target& target, MeshDefinition& to);
    void add_normals(const Target& target, MeshDefinition& to);

    const tinygltf::Model& model_;
    const MeshImporter& meshes_;
    AccessorReader& accessors_;
    GltfReport& report_;
    ByteBudget& budget_;
    SceneDescription& out_;
    std::vector<std::vector<uint32_t>> targets_;  // per mesh: definitions of its targets
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> morphs_;  // mesh, node or kNone
};

}  // namespace kinora
