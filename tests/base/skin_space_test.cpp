// tests/base/skin_space_test.cpp: where a skin stands, by joints whose matrices are known.
#include "runtime/base/skin_space.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

namespace kinora {
namespace {

dmat4 moved(double x, double y, double z) {
    dmat4 m(1.0);
    m[3] = {x, y, z, 1};
    return m;
}

// Two joints that stand at and above `bone`, bound where they stood below `bound`.
SkinPose pose(const dmat4& node, const dmat4& bone, const dmat4& bound) {
    SkinPose p{node, dmat4(1.0), {}};
    for (double height : {0.0, 2.0})
        p.joints.push_back({bone * moved(0, height, 0), glm::inverse(bound * moved(0, height, 0))});
    return p;
}

const dmat4 kIdentity(1.0);

TEST(SkinSpace, ABindShapeMatrixOrANodeAtTheOriginLeavesNothingToAsk) {
    SkinPose posed = pose(moved(1, 2, 3), moved(9, 0, 0), kIdentity);
    EXPECT_EQ(skin_placement(moved(0, 0, 1), posed, posed).space, SkinSpace::World);
    posed.node = kIdentity;
    EXPECT_EQ(skin_placement(kIdentity, posed, posed).space, SkinSpace::World);
}

// Blender writes 1 -2.98023e-8 0 -1.19209e-7 for the identity.
TEST(SkinSpace, AnIdentityThatWasMultipliedAsFloatsIsOne) {
    dmat4 nearly(1.0);
    nearly[1][0] = -2.98023e-8;
    nearly[3][0] = -1.19209e-7;
    dmat4 node = moved(1, 0, 0.5);
    SkinPose rest = pose(node, node, node);
    SkinPlacement place = skin_placement(nearly, rest, rest);
    EXPECT_EQ(place.space, SkinSpace::BindsNode);
    EXPECT_EQ(place.bind, node);
}

TEST(SkinSpace, JointsThatBringTheMeshToTheNodeNeedNoMatrix) {
    dmat4 node = moved(1, 0, 0.5);
    SkinPose rest = pose(node, node, kIdentity);
    EXPECT_EQ(skin_placement(kIdentity, rest, rest).space, SkinSpace::World);
}

// The armature is animated; the file leaves it at the last frame, and its joints were bound at the
// first. Mesh and joints stand below it, so that in every pose the armature's matrix is the mesh's.
TEST(SkinSpace, TheFirstKeysTellWhereTheRestOfTheFileIsNoPoseOfTheBind) {
    dmat4 first = moved(-1, 0, 0), last = moved(2, 1, 0);
    SkinPose rest = pose(last, last, first), start = pose(first, first, first);
    rest.shared = last;
    start.shared = first;
    SkinPlacement place = skin_placement(kIdentity, rest, start);
    EXPECT_EQ(place.space, SkinSpace::BindsNode);
    EXPECT_EQ(place.bind, first);
    for (const dmat4& now : {first, last, moved(7, 7, 7)}) {
        RestJoint joint = pose(now, now, first).joints[1];
        EXPECT_EQ(joint.world * joint.inverse_bind * place.bind, now);
    }
    // Bound at the last frame: what the file says counts, not the first keys.
    rest = pose(last, last, last), start = pose(first, first, last);
    place = skin_placement(kIdentity, rest, start);
    EXPECT_EQ(place.space, SkinSpace::BindsNode);
    EXPECT_EQ(place.bind, last);
}

// What the first joint does to the mesh, as the scene is built.
dmat4 whole(const SkinPlacement& place, const SkinPose& p) {
    const dmat4 moves = p.joints[0].world * p.joints[0].inverse_bind;
    if (place.space == SkinSpace::BindsNode) return moves * place.bind;
    if (place.space == SkinSpace::Node) return p.node * moves;
    if (place.space == SkinSpace::NodeBelow) return p.node * glm::inverse(p.shared) * moves;
    return moves;
}

// A node above mesh and joints moves and scales the result, and nothing else.
TEST(SkinSpace, ANodeAboveAllOfItIsNotTakenForAnAnswer) {
    const dmat4 node = moved(1, 0, 0.5);
    const SkinPose home[] = {pose(node, node, kIdentity),                  // brought to the node
                             pose(node, kIdentity, kIdentity),             // nowhere
                             pose(node, moved(4, 0, 8), moved(0, 0, 4))};  // no pose of the bind
    for (const SkinPose& p : home)
        for (double scale : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e9})
            for (double far : {0.0, 1e9}) {
                dmat4 above = moved(far, -far, far);
                for (int c = 0; c < 3; ++c) above[c] *= scale;
                SkinPose wrapped{above * p.node, above, p.joints};
                for (RestJoint& j : wrapped.joints) j.world = above * j.world;
                const dmat4 want = above * whole(skin_placement(kIdentity, p, p), p),
                            got = whole(skin_placement(kIdentity, wrapped, wrapped), wrapped);
                for (int c = 0; c < 4; ++c)
                    for (int r = 0; r < 3; ++r)
                        EXPECT_NEAR(got[c][r], want[c][r], 1e-9 * scale + 1e-6 * (far > 0))
                            << scale << " " << far;
            }
}

TEST(SkinSpace, CountsJointsThatTurnInsideOut) {
    dmat4 mirror(1.0);
    mirror[0][0] = -1;
    std::vector<RestJoint> joints = {{mirror, kIdentity}, {kIdentity, kIdentity}, {mirror, mirror}};
    EXPECT_EQ(mirroring_joints(kIdentity, joints), 1u);
    EXPECT_EQ(mirroring_joints(mirror, joints), 2u);
}

}  // namespace
}  // namespace kinora
