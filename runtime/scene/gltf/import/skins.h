// runtime/scene/gltf/import/skins.h: glTF's skins with the influences of a mesh's vertices.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "runtime/scene/gltf/import/meshes.h"

namespace kinora {

class SkinImporter {
  public:
    SkinImporter(const tinygltf::Model& model, const MeshImporter& meshes,
                 AccessorReader& accessors, GltfReport& report, SceneDescription& out)
        : model_(model), meshes_(meshes), accessors_(accessors), report_(report), out_(out) {}

    // The definition of a skin on a mesh.
    uint32_t skin_of(uint32_t mesh, uint32_t skin);

  private:
    void read_inverse_bind(uint32_t skin, SkinDefinition& to);
    void add_influences(uint32_t mesh, SkinDefinition& skin);

    const tinygltf::Model& model_;
    const MeshImporter& meshes_;
    AccessorReader& accessors_;
    GltfReport& report_;
    SceneDescription& out_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> skins_;  // mesh, skin
};

}  // namespace kinora
