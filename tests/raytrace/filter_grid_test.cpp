// tests/raytrace/filter_grid_test.cpp: what filters with values below 0 make of functions
// whose mean under them is a sum over the grid.
#include "raytrace/pixels/filter_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "raytrace/sampling.h"

namespace kinora::raytrace::test {
namespace {

constexpr int kSide = 32;
constexpr double kWide = 4, kHigh = 2;

std::vector<float> cells_of(const std::function<double(double, double)>& filter) {
    std::vector<float> values;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            values.push_back(float(filter((x + .5) / kSide * kWide - kWide / 2,
                                          (y + .5) / kSide * kHigh - kHigh / 2)));
    return values;
}

// Lobes below 0 on all sides, and no symmetry.
double lobed(double x, double y) {
    return std::cos(1.2 * x) * std::cos(2 * y) + 0.2 * x * y;
}

double mean_of(const std::vector<float>& values, int samples, uint32_t seed,
               const std::function<double(dvec2)>& seen) {
    const FilterGrid grid(values, kWide, kHigh);
    double sum = 0;
    for (int s = 0; s < samples; ++s)
        sum += grid.weight(s, samples) *
               seen(grid.offset(s, samples, stratified_sample(uint32_t(s), seed)));
    return sum / samples;
}

TEST(FilterGrid, WhatIsEvenStaysEven) {
    for (int samples : {2, 3, 4, 7, 16, 100})
        EXPECT_NEAR(mean_of(cells_of(lobed), samples, 1, [](dvec2) { return 1.0; }), 1, 1e-12)
            << samples;
}

// Cells are even, so the mean of x is that of their middles.
TEST(FilterGrid, MeansAreWeighted) {
    const std::vector<float> values = cells_of(lobed);
    const std::function<double(dvec2)> seen[] = {
        [](dvec2 p) { return p.x; }, [](dvec2 p) { return p.y; }, [](dvec2 p) { return p.x * p.y; },
        [](dvec2 p) { return double(p.x > 0); }};
    for (const auto& f : seen) {
        double sum = 0, all = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double value = double(values[size_t(y * kSide + x)]);
                sum += value * f({(x + .5) / kSide * kWide - kWide / 2,
                                  (y + .5) / kSide * kHigh - kHigh / 2});
                all += value;
            }
        EXPECT_NEAR(mean_of(values, 1 << 16, 3, f), sum / all, 2e-3);
    }
}

// As many seeds give: few samples have no bias.
TEST(FilterGrid, FewSamplesHaveNoBias) {
    const std::vector<float> values = cells_of(lobed);
    auto seen = [](dvec2 p) { return double(p.x + p.y > 0.3); };
    double sum = 0;
    constexpr int kSeeds = 20000;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) sum += mean_of(values, 4, seed, seen);
    EXPECT_NEAR(sum / kSeeds, mean_of(values, 1 << 16, 5, seen), 0.02);
}

TEST(FilterGrid, StaysInItsRectangle) {
    const FilterGrid grid(cells_of([](double x, double y) { return double(x * x + y * y < 1); }),
                          kWide, kHigh);
    for (uint32_t s = 0; s < 256; ++s) {
        const dvec2 at = grid.offset(int(s), 256, stratified_sample(s, 9));
        EXPECT_LT(glm::length(at), 1 + 0.15);
        EXPECT_EQ(grid.weight(int(s), 256), 1);
    }
}

}  // namespace
}  // namespace kinora::raytrace::test
