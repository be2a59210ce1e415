// runtime/vertices/diced_mesh.h: a mesh split into small triangles, with all that lives on its
// corners.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/scene/scene.h"
#include "runtime/vertices/dice.h"

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
    std::vector<Stencil> position_stencils;  // positions of the base mesh
    std::vector<Stencil> normal_stencils;    // normals of the base mesh; no weight in flat groups
    size_t triangles() const;
};

// Whether the edge between two points of a triangle must be split; `corners` are positions of the
// base mesh. Must depend on the two positions alone. Called by several threads.
using DiceTest = FunctionRef<bool(const uint32_t corners[3], DicePoint a, DicePoint b)>;

// Splits the triangles of the groups that are marked in `diced`, and those of the others along the
// edges they share with them. Flat groups that are marked in `moved` get normals, for kernels to
// bend. `base` comes from build_mesh(definition, true). Attributes other than normals are
// interpolated linearly; a group without texture coordinates gets the barycentrics of its old
// triangles as TEXCOORD, so that s and t stay what they were. Nothing when there would be more than
// `limit` triangles.
std::optional<DicedMesh> dice_mesh(const Mesh& base, std::span<const uint8_t> diced,
                                   std::span<const uint8_t> moved, DiceTest too_long, size_t limit);

// The lowest index of the entries at the same position, for each.
std::vector<uint32_t> weld(std::span<const vec4> positions);

// Influences of a skin (as skin::InfluenceSource has them) and morph targets for the new vertices:
// linear between those of the old ones.
void dice_influences(std::span<const Stencil> stencils, std::vector<uint32_t>& first,
                     std::vector<int32_t>& joints, std::vector<double>& weights);
skin::Morph dice_morph(const skin::Morph& from, std::span<const Stencil> positions,
                       std::span<const Stencil> normals);

}  // namespace kinora
