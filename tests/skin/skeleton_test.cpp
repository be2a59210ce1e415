// tests/skin/skeleton_test.cpp: joint matrices and the anchors that keep them accurate.
#include "skin/skeleton.h"

#include <gtest/gtest.h>
#include <glm/matrix.hpp>

#include "character.h"

namespace kinora::skin {
namespace {

TEST(Pose, ComposesWorldInverseBindAndBindShape) {
    std::mt19937 random(1);
    Skeleton skeleton{
        {2, 0}, {random_rigid(random, 1), random_rigid(random, 1)}, random_rigid(random, 1)};
    std::vector<dmat4> nodes{random_rigid(random, 1), random_rigid(random, 1),
                             random_rigid(random, 1)};
    std::vector<JointMatrix> palette(palette_size(skeleton));
    pose(skeleton, nodes, {}, palette);
    for (size_t j = 0; j < 2; ++j) {
        dmat4 expected = nodes[skeleton.nodes[j]] * skeleton.inverse_bind[j] * skeleton.bind_shape;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) EXPECT_NEAR(palette[j + 1].c[c][r], expected[c][r], 1e-6);
    }
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r)
            EXPECT_FLOAT_EQ(palette[0].c[c][r], float(skeleton.bind_shape[c][r]));
        EXPECT_EQ(palette[1].c[c][3], 0);
    }
}

TEST(Pose, TheBindPoseGivesTheBindShapeWhateverTheJoint) {
    std::mt19937 random(2);
    dmat4 joint = random_rigid(random, 5);
    Skeleton skeleton{{0}, {glm::inverse(joint)}, dmat4(1.0)};
    std::vector<JointMatrix> palette(2);
    pose(skeleton, std::vector<dmat4>{joint}, {}, palette);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(palette[1].c[c][r], c == r ? 1 : 0, 1e-6);
}

// docs/numerics.md#skins: all-float skinning errs by 2.4 units at 1e7; composed in double and
// rebased the error is that at the origin.
TEST(Pose, DistanceFromTheWorldsZeroCostsNoAccuracy) {
    for (double distance : {0.0, 1e2, 1e4, 1e6, 1e7}) {
        std::mt19937 random(3);
        dmat4 far(1.0);
        far[3] = dvec4(distance, -distance, distance, 1);
        dmat4 joint = random_rigid(random, 1), bind = random_rigid(random, 1);
        // the whole character was modelled far away: mesh, bind pose and animated pose
        Skeleton skeleton{{0}, {glm::inverse(far * bind)}, dmat4(1.0)};
        std::vector<dmat4> nodes{far * joint};
        std::vector<JointMatrix> palette(2);
        pose(skeleton, nodes, {dvec3(far[3]), dvec3(far[3])}, palette);
        dmat4 expected = joint * glm::inverse(bind);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r)
                EXPECT_NEAR(palette[1].c[c][r], expected[c][r], 1.5e-7 * 3 + 1e-15 * distance * 8)
                    << distance;
    }
}

TEST(Pose, SingularInverseBindMatricesAreUsedAsGiven) {
    Skeleton skeleton{{0}, {dmat4(0.0)}, dmat4(1.0)};
    std::vector<JointMatrix> palette(2);
    pose(skeleton, std::vector<dmat4>{dmat4(1.0)}, {}, palette);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_EQ(palette[1].c[c][r], 0);
}

}  // namespace
}  // namespace kinora::skin
