// runtime/gltf/export/meshes.h: meshes: one vertex for each tuple of indices, influences, targets.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/build/shapes/mesh.h"
#include "runtime/gltf/export/materials.h"

namespace kinora {

class MeshWriter {
  public:
    MeshWriter(const SceneDescription& description, GltfLooks& looks, MaterialWriter& materials,
               GltfDocument& document, BufferWriter& buffer, LossReport& losses)
        : description_(description),
          looks_(looks),
          materials_(materials),
          document_(document),
          buffer_(buffer),
          losses_(losses) {}

    // The mesh of a use with its materials; kNone where it has no triangles.
    uint32_t write(const MeshUse& use);

  private:
    Json primitive(const MeshUse& use, uint32_t group_index, const Mesh& built);
    void add_influences(const MeshUse& use, const std::vector<uint32_t>& positions,
                        Json& attributes);
    void add_targets(const MeshUse& use, const Mesh& built, uint32_t group_index,
                     const std::vector<uint32_t>& corners, Json& primitive);

    const SceneDescription& description_;
    GltfLooks& looks_;
    MaterialWriter& materials_;
    GltfDocument& document_;
    BufferWriter& buffer_;
    LossReport& losses_;
    std::map<std::string, uint32_t> meshes_;  // of mesh, morph, skin and materials
    std::map<uint32_t, Mesh> built_;          // of definitions
};

}  // namespace kinora
