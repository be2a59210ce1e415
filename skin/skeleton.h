// skin/skeleton.h: joints, and the matrices they give to vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::skin {

// COLLADA 1.4.1, chapter 4, skinning: a joint moves a vertex by
//   world_from_joint * inverse_bind * bind_shape.
struct Skeleton {
    std::vector<uint32_t> nodes;      // per joint: index into the scene's node matrices
    std::vector<dmat4> inverse_bind;  // per joint; used as given, singular ones too
    dmat4 bind_shape{1.0};
};

// A 3x4 affine matrix by columns, each padded to 16 bytes: p' = c[0] x + c[1] y + c[2] z + c[3].
struct alignas(64) JointMatrix {
    float c[4][4];
};

// Where the floats on both sides of a joint matrix have their zero.
struct Anchors {
    dvec3 mesh{0.0};   // rest positions are (document position - mesh)
    dvec3 scene{0.0};  // results are (world position - scene)
};

// The palette has one matrix more than there are joints: [0] serves joint -1, which binds to the
// bind shape alone, [1 + j] is joint j.
inline size_t palette_size(const Skeleton& skeleton) {
    return skeleton.nodes.size() + 1;
}

// Fills palette[0 .. joints] from the nodes' world matrices. Composed in double, anchors included,
// and only then rounded to float, so the distance from the world's zero costs nothing.
// `world_from_skin` places joint -1 (identity: a skin's result is in world space).
// palette.size() == palette_size(skeleton); every node index within world_from_node (CHECK).
void pose(const Skeleton& skeleton, std::span<const dmat4> world_from_node, const Anchors& anchors,
          std::span<JointMatrix> palette, const dmat4& world_from_skin = dmat4(1.0));

// A palette that applies one matrix to a morphed or rigid mesh: world_from_mesh, anchors included.
JointMatrix joint_matrix(const dmat4& world_from_mesh, const Anchors& anchors);

}  // namespace kinora::skin
