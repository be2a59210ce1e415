// tests/raytrace/traceable_test.cpp: triangles without extent are found by edges as one by one.
#include "raytrace/traceable_p.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

// A triangle has an extent if its corners are not one point.
std::vector<uint32_t> found_one_by_one(const TestMesh& mesh) {
    std::vector<uint32_t> kept = mesh.triangles;
    for (size_t i = 0; i < kept.size(); i += 3) {
        const vec4 a = mesh.positions[kept[i]], b = mesh.positions[kept[i + 1]],
                   c = mesh.positions[kept[i + 2]];
        if (vec3(a) == vec3(b) && vec3(a) == vec3(c)) kept[i] = kept[i + 1] = kept[i + 2] = kNone;
    }
    return kept == mesh.triangles ? std::vector<uint32_t>() : kept;
}

// Some vertices go to where others are; the last triangle may have no neighbour.
TestMesh collapsed_tube(uint32_t seed) {
    TestMesh mesh = tube(5, 4);
    std::mt19937 random(seed);
    if (seed % 2) mesh.triangles.resize(mesh.triangles.size() - 3);
    for (uint32_t k = random() % 12; k > 0; --k) {
        const vec4 there = mesh.positions[random() % mesh.positions.size()];
        mesh.positions[random() % mesh.positions.size()] = there;
        mesh.positions[random() % mesh.positions.size()] = there;
    }
    return mesh;
}

TEST(SharedEdges, AnswerForBothTriangles) {
    int collapsed = 0;
    for (uint32_t seed = 0; seed < 3000; ++seed) {
        const TestMesh mesh = collapsed_tube(seed);
        const std::vector<uint32_t> edges = shared_edges(mesh.triangles);
        ASSERT_FALSE(edges.empty());
        const std::vector<uint32_t> expected = found_one_by_one(mesh);
        EXPECT_EQ(without_untraceable(mesh.positions, mesh.triangles, 1, edges), expected) << seed;
        EXPECT_EQ(without_untraceable(mesh.positions, mesh.triangles, 1), expected) << seed;
        collapsed += !expected.empty();
    }
    EXPECT_GT(collapsed, 100);
    EXPECT_LT(collapsed, 2900);
}

TEST(SharedEdges, AreThoseOfTwoTrianglesInARow) {
    const uint32_t quads[] = {7, 8, 9, 7, 9, 3, 5, 6, 4, 4, 6, 1, 1, 2, 3};
    EXPECT_EQ(shared_edges(quads), (std::vector<uint32_t>{7, 9, 6, 4, 2, 2}));
    const uint32_t apart[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_TRUE(shared_edges(apart).empty());
    EXPECT_TRUE(shared_edges({}).empty());
}

}  // namespace
}  // namespace kinora::raytrace::test
