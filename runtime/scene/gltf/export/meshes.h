// runtime/scene/gltf/export/meshes.h: meshes: one vertex for each tuple of indices, influences,
// targets.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/scene/gltf/export/materials.h"
#include "runtime/scene/gltf/export/written_mesh.h"

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
    // The point of a mesh about which its positions are written.
    dvec3 origin(uint32_t mesh) { return written(mesh).origin; }

  private:
    const WrittenMesh& written(uint32_t mesh);
    Json primitive(const MeshUse& use, uint32_t group_index, const WrittenMesh& mesh);
    void add_influences(const MeshUse& use, const std::vector<uint32_t>& positions,
                        Json& attributes);
    void add_targets(const MeshUse& use, const WrittenMesh& mesh, uint32_t group_index,
                     const std::vector<uint32_t>& corners, Json& primitive);

    const SceneDescription& description_;
    GltfLooks& looks_;
    MaterialWriter& materials_;
    GltfDocument& document_;
    BufferWriter& buffer_;
    LossReport& losses_;
    std::map<std::string, uint32_t> meshes_;   // of mesh, morph, skin and materials
    std::map<uint32_t, WrittenMesh> written_;  // of definitions
};

}  // namespace kinora
