// runtime/scene/gltf/import/meshes.h: glTF's meshes: each primitive a group with its own vertices.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/import/accessor_reader.h"
#include "runtime/scene/gltf/import/unique_ids.h"

namespace kinora {

// Where the vertices of a primitive lie among its mesh's positions.
struct PrimitiveVertices {
    bool usable = false;
    uint32_t first = 0, count = 0;
    uint32_t group = kNone;  // of the mesh's groups; kNone: it has no triangles
};

class MeshImporter {
  public:
    MeshImporter(const tinygltf::Model& model, AccessorReader& accessors, GltfReport& report,
                 ByteBudget& budget, std::vector<MeshDefinition>& meshes);

    // A definition for each mesh; empty ones where it is not used.
    void import_meshes(const std::vector<bool>& used, UniqueIds& ids);

    std::span<const PrimitiveVertices> primitives(uint32_t mesh) const { return vertices_[mesh]; }

  private:
    std::string_view packed_by(const tinygltf::Primitive& primitive) const;
    void import_primitive(uint32_t mesh, uint32_t primitive);
    bool find_vertices(uint32_t mesh, uint32_t primitive, const std::string& pointer);
    bool read_positions(int accessor, const std::string& pointer, PrimitiveVertices& vertices,
                        std::vector<dvec3>& positions);
    std::vector<uint32_t> triangles_of(const tinygltf::Primitive& primitive, uint32_t vertices,
                                       const std::string& pointer);
    std::vector<uint32_t> finite_triangles(const std::vector<uint32_t>& triangles, uint32_t first,
                                           const std::vector<dvec3>& positions,
                                           const std::string& pointer);
    std::vector<float> add_attributes(const tinygltf::Primitive& primitive,
                                      const PrimitiveVertices& vertices, const std::string& pointer,
                                      PrimitiveGroup& group);

    const tinygltf::Model& model_;
    AccessorReader& accessors_;
    GltfReport& report_;
    ByteBudget& budget_;
    std::vector<MeshDefinition>& meshes_;
    std::vector<std::vector<PrimitiveVertices>> vertices_;  // per mesh and primitive
};

}  // namespace kinora
