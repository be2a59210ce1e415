// tests/skin/skin_test.cpp: every kernel against the scalar double reference.
#include "skin/skin.h"

#include <gtest/gtest.h>

#include <cstring>

#include "allocation_count.h"
#include "character.h"
#include "runtime/base/parallel.h"

namespace kinora::skin {
namespace {

constexpr double kTolerance = 1e-6;  // of the character's extent, about 10

class Kernel : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, Kernel, testing::ValuesIn(deform_kernels()),
                         [](const auto& kernel) { return std::string(kernel.param); });

TEST_P(Kernel, AgreesWithTheDoubleReference) {
    for (int most : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12}) {
        Character c = random_character(333, 20, most, 10 + most);
        Skinned skinned = skin_it(GetParam(), c);
        InfluenceSource source = c.source();
        EXPECT_LT(worst_difference(skinned.positions,
                                   reference::skin_positions(source, c.matrices, c.bind, c.rest)),
                  10 * kTolerance);
    }
}

TEST_P(Kernel, NormalsAgreeWithTheInverseTranspose) {
    // few influences: sums of many random rotations are nearly singular, where no float agrees
    for (int most : {1, 2}) {
        Character c = random_character(500, 20, most, 30 + most);
        for (dmat4& m : c.matrices) m[1] *= 1.7, m[2] *= 0.6;  // uneven scale
        Skinned skinned = skin_it(GetParam(), c);
        auto expected =
            reference::skin_normals(c.source(), c.matrices, c.bind, c.normal_positions, c.normals);
        size_t near = 0;
        for (size_t i = 0; i < expected.size(); ++i) {
            double length = 0, difference = 0;
            for (int k = 0; k < 3; ++k) {
                length += double(skinned.normals[i][k]) * skinned.normals[i][k];
                difference = std::max(difference, std::abs(expected[i][k] - skinned.normals[i][k]));
            }
            EXPECT_NEAR(length, 1, 1e-6);
            near += difference < 1e-6;
        }
        EXPECT_GE(near, most == 1 ? expected.size() : expected.size() * 95 / 100);
    }
}

TEST_P(Kernel, GivesTheBitsOfThePortableKernel) {
    for (int most : {1, 4, 7}) {
        Character c = random_character(1003, 30, most, 50 + most);
        Skinned a = skin_it(GetParam(), c), b = skin_it("portable", c);
        EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), 16 * a.positions.size()), 0);
        EXPECT_EQ(std::memcmp(a.normals.data(), b.normals.data(), 16 * a.normals.size()), 0);
    }
}

TEST_P(Kernel, IdentityGivesTheMeshBack) {
    Character c = random_character(100, 8, 5, 70);
    for (dmat4& m : c.matrices) m = dmat4(1.0);
    c.bind = dmat4(1.0);
    Skinned skinned = skin_it(GetParam(), c);
    EXPECT_LT(worst_difference(skinned.positions, c.rest), 1e-6);
}

TEST_P(Kernel, EveryVertexCountUpToThreeBlocksIsWhole) {
    Character all = random_character(48, 6, 3, 80);
    Skinned whole = skin_it(GetParam(), all);
    for (size_t n = 0; n <= 48; ++n) {
        Character c = all;
        c.rest.resize(n), c.first.resize(n + 1), c.normals.resize(n), c.normal_positions.resize(n);
        Skinned part = skin_it(GetParam(), c);
        for (size_t i = 0; i < n; ++i) {
            EXPECT_EQ(part.positions[i], whole.positions[i]);
            EXPECT_EQ(part.normals[i], whole.normals[i]);
        }
    }
}

TEST_P(Kernel, SeveralNormalsMayShareAPosition) {
    Character c = random_character(60, 10, 2, 90);
    Skinned own = skin_it(GetParam(), c);
    Character corners = c;
    corners.normals.clear(), corners.normal_positions.clear();
    for (int i = 0; i < 200; ++i) corners.add_normal(c.normals[i * 7 % 60], i * 7 % 60);
    Skinned shared = skin_it(GetParam(), corners);
    for (int i = 0; i < 200; ++i) EXPECT_EQ(shared.normals[i], own.normals[i * 7 % 60]);
    for (int i = 0; i < 60; ++i) EXPECT_EQ(shared.positions[i], own.positions[i]);
}

TEST_P(Kernel, MeshesWithoutNormalsMove) {
    Character c = random_character(40, 4, 4, 95);
    c.normals.clear(), c.normal_positions.clear();
    EXPECT_LT(worst_difference(skin_it(GetParam(), c).positions,
                               reference::skin_positions(c.source(), c.matrices, c.bind, c.rest)),
              10 * kTolerance);
}

TEST(Skin, ThreadsGiveTheSameBits) {
    Character c = random_character(20000, 30, 4, 99);
    set_thread_count(1);
    Skinned one = skin_it(deform_kernels()[0], c);
    set_thread_count(2);
    Skinned two = skin_it(deform_kernels()[0], c);
    EXPECT_EQ(std::memcmp(one.positions.data(), two.positions.data(), 16 * 20000), 0);
    EXPECT_EQ(std::memcmp(one.normals.data(), two.normals.data(), 16 * 20000), 0);
}

TEST(Skin, PosingAndDeformingAllocateNothing) {
    Character c = random_character(5000, 30, 4, 98);
    SkinMesh skin = build_skin(c.source(), c.normal_positions);
    Skeleton skeleton{std::vector<uint32_t>(30, 0), std::vector<dmat4>(30, dmat4(1.0)), dmat4(1.0)};
    std::vector<dmat4> nodes{dmat4(1.0)};
    std::vector<JointMatrix> palette(palette_size(skeleton));
    auto rest = padded_floats(c.rest), rest_normals = padded_floats(c.normals);
    std::vector<vec4> positions(rest.size()), normals(rest.size());
    set_thread_count(1);
    auto frame = [&] {
        pose(skeleton, nodes, {}, palette);
        deform(skin, palette, rest, rest_normals, positions, normals);
    };
    frame();
    size_t before = allocation_count();
    for (int i = 0; i < 24; ++i) frame();
    EXPECT_EQ(allocation_count(), before);
}

TEST(Skin, TheFastestKernelIsTheDefault) {
    Character c = random_character(100, 8, 4, 97);
    Skinned named = skin_it(deform_kernels()[0], c);
    std::vector<vec4> positions(100), normals(100);
    deform(build_skin(c.source(), c.normal_positions), c.palette(), padded_floats(c.rest),
           padded_floats(c.normals), positions, normals);
    EXPECT_EQ(positions, named.positions);
    EXPECT_STREQ(deform_kernels().back(), "portable");
}

}  // namespace
}  // namespace kinora::skin
