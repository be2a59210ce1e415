// tests/runtime/scene/images/map_distribution_test.cpp: directions by the brightness of a map,
// against sums over the sphere.
#include "runtime/scene/images/map_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace kinora {
namespace {

constexpr uint32_t kColumns = 32, kRows = 16;

size_t texel(uint32_t row, uint32_t column) {
    return size_t(row) * kColumns + column;
}

// Smooth, with a sun of one texel and a black part.
std::vector<float> sky() {
    std::vector<float> b(size_t(kColumns) * kRows);
    for (uint32_t y = 0; y < kRows; ++y)
        for (uint32_t x = 0; x < kColumns; ++x)
            b[texel(y, x)] = y > 10 ? 0.0f : 0.3f + 0.2f * float(x % 7) + 0.1f * float(y);
    b[texel(3, 20)] = 500;
    return b;
}

// Of f over all directions, by midpoints of latitudes and longitudes.
template <class F>
double integral(F&& f) {
    constexpr int kSteps = 512;
    double sum = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < 2 * kSteps; ++i) {
            const double theta = kPi * (j + 0.5) / kSteps, phi = kPi * (i + 0.5) / kSteps;
            const dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                          std::sin(theta) * std::sin(phi));
            sum += double(f(vec3(d))) * std::sin(theta) * (kPi / kSteps) * (kPi / kSteps);
        }
    return sum;
}

TEST(MapDistribution, IsADensity) {
    const MapDistribution map(kColumns, kRows, sky());
    EXPECT_NEAR(integral([&](vec3 d) { return map.density(d); }), 1, 1e-3);
    EXPECT_NEAR(integral([&](vec3 d) { return MapDistribution().density(d); }), 1, 1e-5);
}

// The mean of f / density over directions is the integral of f, and each has the density it is
// given.
TEST(MapDistribution, DirectionsHaveTheirDensity) {
    const MapDistribution map(kColumns, kRows, sky());
    auto f = [](vec3 d) { return d.x > 0 ? 1.0f + d.y : 0.5f * d.z * d.z; };
    auto shown = [&](vec3 d) { return map.density(d) > 0 ? f(d) : 0.0f; };
    constexpr int kSide = 500;
    double sum = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            float density = 0;
            const vec3 d = map.direction({(i + 0.5f) / kSide, (j + 0.5f) / kSide}, density);
            ASSERT_GT(density, 0);
            EXPECT_NEAR(map.density(d), density, 1e-4 * density);
            EXPECT_NEAR(glm::length(d), 1, 1e-6);
            sum += double(f(d)) / double(density);
        }
    EXPECT_NEAR(sum / kSide / kSide, integral(shown), 0.01 * integral(shown));
}

// Directions that are chosen beside the picture's edges and about the poles, too.
TEST(MapDistribution, DirectionsOfLargeMapsHaveTheirDensity) {
    constexpr uint32_t kWide = 256, kHigh = 128;
    std::vector<float> b(size_t(kWide) * kHigh);
    for (uint32_t y = 0; y < kHigh; ++y)
        for (uint32_t x = 0; x < kWide; ++x)
            b[size_t(y) * kWide + x] = 2 + float(std::sin(0.3 * x) * std::cos(0.2 * y));
    for (uint32_t x : {0u, kWide - 1}) b[size_t(40) * kWide + x] = 40;
    for (uint32_t y : {0u, kHigh - 1}) b[size_t(y) * kWide + 7] = 900;
    const MapDistribution map(kWide, kHigh, b);
    for (int j = 0; j < 300; ++j)
        for (int i = 0; i < 300; ++i) {
            const vec2 u((i + 0.5f) / 300, (j + 0.5f) / 300);
            float density = 0;
            const vec3 d = map.direction(u, density);
            ASSERT_GT(density, 0);
            ASSERT_NEAR(map.density(d), density, 1e-4 * density) << i << ' ' << j;
        }
}

// As bright as a lookup between four texels, up to a factor, away from the poles.
TEST(MapDistribution, FollowsTheMapBetweenTexels) {
    const MapDistribution map(kColumns, kRows, sky());
    auto at = [&](double column, double row) {  // in texels; middles at halves
        const double theta = kPi * row / kRows, phi = 2 * kPi * (column / kColumns - 0.5);
        return double(map.density(vec3(dvec3(-std::sin(theta) * std::sin(phi), std::cos(theta),
                                             std::sin(theta) * std::cos(phi)))));
    };
    EXPECT_NEAR(at(20.5, 3.5) / at(10.5, 3.5), 500 / double(sky()[texel(3, 10)]), 0.2);
    const double beside = double(sky()[texel(3, 21)]);
    EXPECT_NEAR(at(21, 3.5) / at(20.5, 3.5), (500 + beside) / 2 / 500, 1e-3);
    EXPECT_EQ(at(20.5, 13.5), 0);  // black, with black neighbours
    EXPECT_GT(at(20.5, 11.4), 0);  // what a lookup sees of the row above
}

TEST(MapDistribution, TakesOneTexelAndOneColor) {
    std::vector<float> b(size_t(kColumns) * kRows, 0.0f);
    b[texel(7, 0)] = 1e30f;
    const MapDistribution one(kColumns, kRows, b);
    float density = 0;
    for (float u : {0.01f, 0.3f, 0.99f}) {
        const vec3 d = one.direction({u, 1 - u}, density);
        EXPECT_GT(density, 0) << u;
        // Column 0 ends at the picture's left edge, which looks along -z.
        EXPECT_LT(glm::length(d - vec3(0.1f, 0.1f, -1.0f)), 0.4f) << u;
    }
    const MapDistribution even(kColumns, kRows, std::vector<float>(b.size(), 0.7f));
    even.direction({0.2f, 0.6f}, density);
    EXPECT_EQ(density, MapDistribution().density({0, 1, 0}));
    EXPECT_NEAR(density, 1 / (4 * kPi), 1e-7);
}

TEST(MapDistribution, OfNoLightGivesNone) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (float b : {0.0f, -3.0f, kNaN, std::numeric_limits<float>::infinity()}) {
        const MapDistribution map(kColumns, kRows, std::vector<float>(kColumns * kRows, b));
        float density = 1;
        EXPECT_NEAR(glm::length(map.direction({0.3f, 0.4f}, density)), 1, 1e-6);
        EXPECT_EQ(density, 0);
        EXPECT_EQ(map.density({1, 0, 0}), 0);
    }
    float density = 0;
    const MapDistribution map(kColumns, kRows, sky());
    map.direction({kNaN, 7.0f}, density);
    EXPECT_GT(density, 0);
    EXPECT_EQ(map.density({0, 0, 0}), 0);
    EXPECT_EQ(map.density({kNaN, 0, 0}), 0);
}

}  // namespace
}  // namespace kinora
