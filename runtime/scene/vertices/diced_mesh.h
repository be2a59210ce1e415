// runtime/scene/vertices/diced_mesh.h: a mesh split into small triangles, with all that lives on
// its corners.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/shapes.h"
#include "runtime/scene/vertices/dice_parts.h"

namespace kinora {

// A new vertex as a weighted sum of up to three old entries.
struct Stencil {
    uint32_t entry[3];
    float weight[3];
};
dvec3 combine(const Stencil& stencil, std::span<const vec4> entries);

// A wedge is a vertex as one group's corners see it: a position with one normal and one value of
// each attribute. Kernels that move vertices run once a wedge.
struct DicedGroup {
    std::vector<uint32_t> corners;           // wedge of each triangle corner
    std::vector<uint32_t> position, normal;  // of each wedge: entries of the mesh
    // The file gives no normals: the entries, if there are any, are those of the old triangles,
    // none of which shares a wedge with another.
    bool flat = false;
};

struct DicedMesh {
    Mesh mesh;  // undisplaced; every normal entry belongs to one group and one position
    std::vector<DicedGroup> groups;
    // Of positions and normals of the base mesh, the latter without weight in flat groups; or none.
    std::vector<Stencil> position_stencils, normal_stencils;
    size_t triangles() const;
};

// Makes the mesh of what dice_parts() made of `base`, which comes from build_mesh(definition,
// true). Flat groups that are marked in `moved` get normals, for kernels to bend. Attributes other
// than normals are interpolated linearly; a group without texture coordinates gets the barycentrics
// of its old triangles as TEXCOORD, so that s and t stay what they were. Without `stencils` the
// result has none: what a skin or morph moves wants them.
DicedMesh diced_mesh(const Mesh& base, std::span<const uint8_t> moved, const DicedParts& parts,
                     bool stencils);

// Influences of a skin (as skin::InfluenceSource has them) and morph targets for the new vertices:
// linear between those of the old ones.
void dice_influences(std::span<const Stencil> stencils, std::vector<uint32_t>& first,
                     std::vector<int32_t>& joints, std::vector<double>& weights);
skin::Morph dice_morph(const skin::Morph& from, std::span<const Stencil> positions,
                       std::span<const Stencil> normals);

}  // namespace kinora
