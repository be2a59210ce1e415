// tests/skin/skin_extremes_test.cpp: the edge cases of docs/numerics.md#skins.
#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include <limits>

#include "character.h"

namespace kinora::skin {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

dmat4 moved(double x, double y = 0, double z = 0) {
    dmat4 m(1.0);
    m[3] = dvec4(x, y, z, 1);
    return m;
}
dmat4 scaled(double x, double y, double z) {
    dmat4 m(1.0);
    m[0][0] = x, m[1][1] = y, m[2][2] = z;
    return m;
}

// One vertex at the origin of a character whose joint j stands at x = 10 j, bind shape at x = -1.
Character one_vertex(int joints, const std::vector<std::pair<int, double>>& influences) {
    Character c;
    for (int j = 0; j < joints; ++j) c.matrices.push_back(moved(10 * j));
    c.bind = moved(-1);
    c.add_vertex(dvec3(0), influences);
    return c;
}

float skinned_x(const Character& c, SkinRepairs* repairs = nullptr) {
    SkinMesh skin = build_skin(c.source(), c.normal_positions, repairs);
    return skin_it(deform_kernels()[0], c, skin, c.palette()).positions[0].x;
}

TEST(SkinExtremes, WeightsAreScaledToOneAndLargeErrorsCounted) {
    for (double sum : {0.9, 1.1}) {
        SkinRepairs repairs;
        EXPECT_FLOAT_EQ(skinned_x(one_vertex(2, {{0, sum / 2}, {1, sum / 2}}), &repairs), 5);
        EXPECT_EQ(repairs.weight_sum, 1u);
        EXPECT_NEAR(repairs.worst_sum, sum, 1e-12);
    }
    SkinRepairs repairs;
    EXPECT_FLOAT_EQ(skinned_x(one_vertex(2, {{0, 0.5}, {1, 0.5005}}), &repairs), 5.0025);
    EXPECT_FALSE(repairs.any());
}

TEST(SkinExtremes, NotNormalisingTakesWeightsAsTheyAre) {
    Character c = one_vertex(2, {{1, 0.5}});
    InfluenceSource source = c.source();
    source.normalise = false;
    SkinMesh skin = build_skin(source, {});
    EXPECT_FLOAT_EQ(skin_it("portable", c, skin, c.palette()).positions[0].x, 5);
}

TEST(SkinExtremes, VerticesWithoutWeightFollowTheRoot) {
    for (auto influences : std::vector<std::vector<std::pair<int, double>>>{
             {}, {{1, 0.0}, {2, 0.0}}, {{1, kNan}}, {{1, 1.0}, {2, -1.0}}}) {
        SkinRepairs repairs;
        Character c = one_vertex(3, influences);
        c.matrices[0] = moved(3);
        EXPECT_EQ(skinned_x(c, &repairs), 3);
        EXPECT_EQ(repairs.unweighted, 1u);
    }
}

TEST(SkinExtremes, NegativeWeightsExtrapolateAndNanWeightsAreZero) {
    EXPECT_FLOAT_EQ(skinned_x(one_vertex(2, {{0, -0.5}, {1, 1.5}})), 15);
    SkinRepairs repairs;
    EXPECT_FLOAT_EQ(skinned_x(one_vertex(2, {{0, kNan}, {1, 1.0}}), &repairs), 10);
    EXPECT_EQ(repairs.non_finite, 1u);
}

TEST(SkinExtremes, JointMinusOneBindsToTheBindShape) {
    EXPECT_EQ(skinned_x(one_vertex(2, {{-1, 1.0}})), -1);
    EXPECT_FLOAT_EQ(skinned_x(one_vertex(2, {{-1, 0.5}, {1, 0.5}})), 4.5);
}

TEST(SkinExtremes, JointsOutOfRangeAreDroppedAndCounted) {
    SkinRepairs repairs;
    EXPECT_EQ(skinned_x(one_vertex(2, {{7, 0.5}, {-2, 0.1}, {1, 0.5}}), &repairs), 10);
    EXPECT_EQ(repairs.joint_range, 2u);
}

TEST(SkinExtremes, SeventyThousandJointsAreToldApart) {
    Character c = one_vertex(70000, {{69999, 1.0}});
    EXPECT_EQ(skinned_x(c), 699990);
    EXPECT_EQ(skinned_x(one_vertex(70000, {{65537, 0.5}, {65535, 0.5}})), 655360);
}

TEST(SkinExtremes, AHundredInfluencesAllCount) {
    std::vector<std::pair<int, double>> influences;
    for (int j = 0; j < 100; ++j) influences.push_back({j, 0.01 * (j + 1)});
    Character c = one_vertex(100, influences);
    SkinRepairs repairs;
    double expected = reference::skin_positions(c.source(), c.matrices, c.bind, c.rest)[0].x;
    EXPECT_NEAR(skinned_x(c, &repairs), expected, 1e-6 * 1000);
    EXPECT_EQ(repairs.most_influences, 100u);
    EXPECT_EQ(repairs.dropped, 0u);
}

TEST(SkinExtremes, DraftKeepsTheLargestAndReportsWhatItDropped) {
    Character c = one_vertex(3, {{0, 0.1}, {1, 0.5}, {2, 0.4}});
    InfluenceSource source = c.source();
    source.max_influences = 2;
    SkinRepairs repairs;
    SkinMesh skin = build_skin(source, {}, &repairs);
    EXPECT_NEAR(skin_it("portable", c, skin, c.palette()).positions[0].x, (5 + 8) / 0.9, 1e-5);
    EXPECT_EQ(repairs.dropped, 1u);
    EXPECT_NEAR(repairs.largest_dropped, 0.1, 1e-12);
}

TEST(SkinExtremes, BrokenInfluenceRangesAreCutOff) {
    std::vector<uint32_t> first{0, 1, 900, 2};
    std::vector<int32_t> joints{0, 1};
    std::vector<double> weights{1, 1};
    SkinRepairs repairs;
    SkinMesh skin = build_skin({first, joints, weights, 2}, {}, &repairs);
    EXPECT_EQ(skin.positions.count, 3u);
    EXPECT_EQ(repairs.unweighted, 1u);
}

class NormalKernel : public testing::TestWithParam<const char*> {
  protected:
    vec4 normal_under(const dmat4& m, const dvec3& n) {
        Character c;
        c.matrices = {m};
        c.add_vertex(dvec3(0), {{0, 1.0}});
        c.add_normal(n, 0);
        return skin_it(GetParam(), c).normals[0];
    }
};
INSTANTIATE_TEST_SUITE_P(All, NormalKernel, testing::ValuesIn(deform_kernels()),
                         [](const auto& kernel) { return std::string(kernel.param); });

TEST_P(NormalKernel, MirroredNormalsStayRightSideOut) {
    // a plane x = 1 with its normal outward (+x), mirrored to x = -1: outward is -x
    EXPECT_EQ(normal_under(scaled(-1, 1, 1), {1, 0, 0}), vec4(-1, 0, 0, 0));
    EXPECT_EQ(normal_under(scaled(-1, 1, 1), {0, 1, 0}), vec4(0, 1, 0, 0));
    EXPECT_EQ(normal_under(scaled(-2, -2, -2), {0, 0, 1}), vec4(0, 0, -1, 0));
}

TEST_P(NormalKernel, UnevenScaleTurnsNormalsByTheInverseTranspose) {
    vec4 n = normal_under(scaled(2, 1, 1), {1, 1, 0});
    EXPECT_NEAR(n.y / n.x, 2, 1e-6);
}

TEST_P(NormalKernel, ExtremeScalesGiveFiniteUnitNormals) {
    for (double scale : {1e-20, 1e-12, 1e12, 1e20}) {
        for (auto m : {scaled(scale, 1, 1), scaled(1, scale, scale), scaled(scale, scale, scale)}) {
            for (dvec3 n : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0.5, -0.5, 0.7)}) {
                vec4 out = normal_under(m, n);
                dvec3 expected = n / dvec3(m[0][0], m[1][1], m[2][2]);
                double length = std::sqrt(expected.x * expected.x + expected.y * expected.y +
                                          expected.z * expected.z);
                for (int k = 0; k < 3; ++k) EXPECT_NEAR(out[k], expected[k] / length, 1e-6);
            }
        }
        EXPECT_EQ(normal_under(scaled(-scale, scale, scale), {1, 0, 0}), vec4(-1, 0, 0, 0));
    }
}

TEST_P(NormalKernel, NormalsThatVanishAreZero) {
    EXPECT_EQ(normal_under(dmat4(1.0), {0, 0, 0}), vec4(0));
    EXPECT_EQ(normal_under(dmat4(0.0), {1, 0, 0}), vec4(0));
    EXPECT_EQ(normal_under(scaled(1, 1, 0), {1, 0, 0}), vec4(0));  // seen edge on
    EXPECT_EQ(normal_under(scaled(1, 1, 0), {0, 0, 2}), vec4(0, 0, 1, 0));
    EXPECT_EQ(normal_under(dmat4(kNan), {1, 0, 0}), vec4(0));
}

TEST_P(NormalKernel, OneBadNormalLeavesItsNeighboursAlone) {
    Character c = random_character(64, 4, 1, 5);
    Skinned good = skin_it(GetParam(), c);
    c.normals[21] = dvec3(0);
    Skinned one_bad = skin_it(GetParam(), c);
    for (size_t i = 0; i < 64; ++i)
        EXPECT_EQ(one_bad.normals[i], i == 21 ? vec4(0) : good.normals[i]);
}

}  // namespace
}  // namespace kinora::skin
