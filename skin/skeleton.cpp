// skin/skeleton.cpp: joint matrices, composed in double.
#include "skin/skeleton.h"

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"

namespace kinora::skin {
namespace {

dmat4 translation(const dvec3& by) {
    dmat4 m(1.0);
    m[3] = dvec4(by, 1.0);
    return m;
}

// scene_from_world comes first: it takes the large part off while the numbers are still doubles,
// and before the products mix it with the small ones.
JointMatrix rounded(const dmat4& world_from_joint, const dmat4& joint_from_rest,
                    const Anchors& anchors) {
    dmat4 m = (translation(-anchors.scene) * world_from_joint) * joint_from_rest;
    JointMatrix joint;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) joint.c[column][row] = static_cast<float>(m[column][row]);
        joint.c[column][3] = 0;
    }
    return joint;
}

}  // namespace

JointMatrix joint_matrix(const dmat4& world_from_mesh, const Anchors& anchors) {
    return rounded(world_from_mesh, translation(anchors.mesh), anchors);
}

void pose(const Skeleton& skeleton, std::span<const dmat4> world_from_node, const Anchors& anchors,
          std::span<JointMatrix> palette, const dmat4& world_from_skin) {
    CHECK_EQ(skeleton.nodes.size(), skeleton.inverse_bind.size());
    CHECK_EQ(palette.size(), palette_size(skeleton));
    dmat4 bind_from_rest = skeleton.bind_shape * translation(anchors.mesh);
    palette[0] = rounded(world_from_skin, bind_from_rest, anchors);
    parallel_for(0, skeleton.nodes.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t j = begin; j < end; ++j) {
            CHECK_LT(skeleton.nodes[j], world_from_node.size());
            palette[j + 1] = rounded(world_from_node[skeleton.nodes[j]],
                                     skeleton.inverse_bind[j] * bind_from_rest, anchors);
        }
    });
}

}  // namespace kinora::skin
