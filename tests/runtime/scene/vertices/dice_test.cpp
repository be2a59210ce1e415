// tests/runtime/scene/vertices/dice_test.cpp: triangles split by rules on their edges.
#include "runtime/scene/vertices/dice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>

namespace kinora {
namespace {

dvec3 at(const dvec3 corners[3], DicePoint p) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += double(p.weight(k)) / kDiceOne * corners[k];
    return sum;
}

DiceMetric metric_of(const dvec3 c[3]) {
    dvec3 e1 = c[1] - c[0], e2 = c[2] - c[0];
    return {glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e2, e2)};
}

// Splits down to edges of `longest`.
DicedTriangle dice_to(const dvec3 c[3], double longest) {
    DicedTriangle out;
    auto too_long = [&](DicePoint a, DicePoint b) {
        return glm::length(at(c, b) - at(c, a)) > longest;
    };
    EXPECT_TRUE(dice_triangle(metric_of(c), too_long, 10'000'000, out));
    return out;
}

TEST(Dice, LeavesNoLongEdgeAndCoversTheTriangleOnce) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int round = 0; round < 40; ++round) {
        dvec3 c[3];
        for (dvec3& p : c) p = {uniform(random), uniform(random), uniform(random)};
        DicedTriangle d = dice_to(c, 0.13);
        dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
        double area = 0;
        for (size_t t = 0; t < d.triangles.size(); t += 3) {
            dvec3 p[3];
            for (size_t k = 0; k < 3; ++k) p[k] = at(c, d.points[d.triangles[t + k]]);
            for (int k = 0; k < 3; ++k) EXPECT_LE(glm::length(p[(k + 1) % 3] - p[k]), 0.13);
            dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
            EXPECT_GT(glm::dot(n, normal), 0);  // winds as it did
            area += glm::length(n);
        }
        EXPECT_NEAR(area, glm::length(normal), 1e-9 * area);
    }
}

TEST(Dice, EveryEdgeInsideHasTwoTrianglesAndEveryOneOnTheRimOne) {
    dvec3 c[3] = {{0, 0, 0}, {5, 0.3, 0}, {0.2, 1, 0}};
    DicedTriangle d = dice_to(c, 0.11);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t k = 0; k < d.triangles.size(); ++k) {
        uint32_t a = d.triangles[k], b = d.triangles[k - k % 3 + (k + 1) % 3];
        ++edges[std::minmax(a, b)];
    }
    for (auto [edge, count] : edges) {
        DicePoint a = d.points[edge.first], b = d.points[edge.second];
        bool rim = false;
        for (int k = 0; k < 3; ++k) rim |= a.weight(k) == 0 && b.weight(k) == 0;
        EXPECT_EQ(count, rim ? 1 : 2);
    }
}

TEST(Dice, IsFineOnlyWhereEdgesAreTooLong) {
    // A plane of 2000 units seen from one unit above: edges as long as they are far.
    dvec3 c[3] = {{-1000, -1000, 0}, {3000, -1000, 0}, {-1000, 3000, 0}};
    DicedTriangle d;
    auto too_long = [&](DicePoint a, DicePoint b) {
        dvec3 p = at(c, a), q = at(c, b), m = 0.5 * (p + q), h = 0.5 * (q - p);
        double t = std::clamp(-glm::dot(m, h) / glm::dot(h, h), -1.0, 1.0);
        return 2 * glm::length(h) > 0.05 * std::sqrt(1 + glm::dot(m + t * h, m + t * h));
    };
    ASSERT_TRUE(dice_triangle(metric_of(c), too_long, 1'000'000, d));
    EXPECT_LT(d.triangles.size() / 3, 200'000u);  // uniformly it would be 1e10
    double shortest = 1e9, longest = 0;
    for (size_t t = 0; t < d.triangles.size(); t += 3) {
        double length =
            glm::length(at(c, d.points[d.triangles[t]]) - at(c, d.points[d.triangles[t + 1]]));
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    EXPECT_LT(shortest, 0.06);
    EXPECT_GT(longest, 20);
}

TEST(Dice, StopsAtTheLimitAndAtTheFinestPoints) {
    DicedTriangle d;
    auto always = [](DicePoint, DicePoint) { return true; };
    EXPECT_FALSE(dice_triangle({}, always, 1000, d));
    // A rule that never has enough near one corner ends with the units of DicePoint.
    auto corner = [](DicePoint a, DicePoint b) { return a.i + a.j == 0 || b.i + b.j == 0; };
    EXPECT_TRUE(dice_triangle({}, corner, 100'000, d));
    EXPECT_GT(d.triangles.size() / 3, 20u);
}

raytrace::Camera camera_at(dvec3 eye) {
    raytrace::Camera camera;
    camera.eye = eye;
    camera.width = 200;
    camera.height = 100;
    camera.half_width = 1;
    camera.half_height = 0.5;
    camera.znear = 0.01;
    return camera;
}

TEST(Dice, EdgePixelsAreLengthOverDistance) {
    raytrace::Camera camera = camera_at({0, 0, 0});
    // 0.2 units at distance 10 of a picture 2 x 10 units and 200 pixels wide there.
    EXPECT_NEAR(edge_pixels(camera, {-0.1, 0, 10}, {0.1, 0, 10}), 2, 1e-9);
    // Pointing at the eye it is as long: displacement may turn it.
    EXPECT_NEAR(edge_pixels(camera, {0, 0, 10}, {0, 0, 10.2}), 2, 1e-9);
    // Behind the eye and beside the picture a quarter.
    EXPECT_NEAR(edge_pixels(camera, {-0.1, 0, -10}, {0.1, 0, -10}), 0.5, 1e-9);
    EXPECT_NEAR(edge_pixels(camera, {0, 7.9, 6}, {0, 8, 6}),
                0.25 * 0.1 * 100 / std::sqrt(7.9 * 7.9 + 36), 1e-9);
    camera.orthographic = true;
    EXPECT_NEAR(edge_pixels(camera, {-0.1, 0, 10}, {0.1, 0, 99}), 100 * std::hypot(0.2, 89.0),
                1e-6);
    EXPECT_EQ(edge_pixels(camera, {1, 1, 1}, {1, 1, 1}), 0);
}

TEST(Dice, EdgePixelsAreTheSameBitsBothWays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-5, 5);
    raytrace::Camera camera = camera_at({0.3, 0.1, -0.2});
    for (int i = 0; i < 10000; ++i) {
        dvec3 a(uniform(random), uniform(random), uniform(random));
        dvec3 b(uniform(random), uniform(random), uniform(random));
        camera.orthographic = i % 3 == 0;
        ASSERT_EQ(edge_pixels(camera, a, b), edge_pixels(camera, b, a));
    }
}

}  // namespace
}  // namespace kinora
