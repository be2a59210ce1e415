// runtime/scene/ri/meshes/merged_meshes.h: many small primitives of one look as few large meshes.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora::ri {

class MergedMeshes {
  public:
    // Meshes that differ in these stay apart.
    struct Look {
        uint32_t material;
        std::vector<uint32_t> lights;
        uint32_t visibility;  // as bits
        std::string name;
        auto operator<=>(const Look&) const = default;
    };

    // Whether a mesh may stand in another one's space: it is small, and none of its variables but
    // its normals is a place or direction.
    static bool takes(const MeshDefinition& mesh);

    // Appends it, moved by a matrix that has an inverse, to the mesh of its look among `meshes`.
    // Cs is its colour where no variable is. Returns the index of a mesh that this look had not
    // yet, or kNone.
    uint32_t add(std::vector<MeshDefinition>& meshes, const MeshDefinition& mesh, const Look& look,
                 const dmat4& matrix, const dvec3& color);

  private:
    // Its variables, and about how large: vertices are floats about the middle of their mesh.
    using Kind = std::pair<std::string, int>;
    std::map<std::pair<Look, Kind>, uint32_t> open_;
    std::vector<dvec3> positions_;  // of the mesh that is added
};

}  // namespace kinora::ri
