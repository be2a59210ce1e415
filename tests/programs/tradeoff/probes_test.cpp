// tests/programs/tradeoff/probes_test.cpp: distances of hits, vertices, colors in ULP.
#include "runtime/programs/tradeoff/probes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kinora {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

TEST(Hits, DifferInDistanceOrAltogether) {
    std::vector<float> a{1, 2, kInfinite, kInfinite}, b{1.5f, 2, 3, kInfinite};
    HitErrors errors = hit_errors(a, b);
    EXPECT_DOUBLE_EQ(errors.distance, 0.5);
    EXPECT_DOUBLE_EQ(errors.mismatch, 0.25);
    EXPECT_EQ(hit_errors(a, a).mismatch, 0);
}

TEST(Steps, AreOfTheSameVertices) {
    std::vector<std::vector<dvec3>> a{{{0, 0, 0}, {1, 0, 0}}}, b{{{0, 0, 0}, {1, 3, 4}}};
    EXPECT_DOUBLE_EQ(largest_step(a, b).value(), 5);
    b[0].pop_back();
    EXPECT_FALSE(largest_step(a, b));
}

// A camera that sees 2 units at distance 1 in 100 pixels: 50 pixels a unit there, 25 at distance 2.
TEST(Steps, ShrinkWithTheirDistance) {
    SceneExtent scene;
    Pose pose;
    pose.view.width = pose.view.height = 100;
    pose.view.half_width = pose.view.half_height = 1;
    std::vector<std::vector<dvec3>> a{{{0, 0, 1}, {0, 0, 2}}}, b{{{0.1, 0, 1}, {0, 0.3, 2}}};
    EXPECT_NEAR(largest_step_pixels(scene, pose, a, b).value(), 7.5, 1e-12);
    a = {{{0, 0, 1}, {0, 0, -1}}}, b = {{{0.1, 0, 1}, {9, 9, -1}}};
    EXPECT_NEAR(largest_step_pixels(scene, pose, a, b).value(), 5,
                1e-12);  // what is behind is not seen
}

TEST(UlpErrors, AreOfPixelsThatHitTheSame) {
    std::vector<vec4> a{vec4(1), vec4(1), vec4(1)}, b = a;
    b[0].x = std::nextafter(std::nextafter(1.0f, 2.0f), 2.0f);
    b[1].x = 7;  // another hit
    b[2].x = 9;  // no hit
    std::vector<float> hits_a{1, 2, kInfinite}, hits_b{1, 3, kInfinite};
    UlpErrors errors = ulp_errors({3, 1, a}, {3, 1, b}, hits_a, hits_b);
    EXPECT_EQ(errors.max, 2);
}

}  // namespace
}  // namespace kinora
