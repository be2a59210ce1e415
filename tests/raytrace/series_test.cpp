// tests/raytrace/series_test.cpp: what the samples of a pixel draw together is stratified.
#include "raytrace/random/series.h"

#include <gtest/gtest.h>
#include <cmath>
#include <set>
#include <vector>

#include "raytrace/hits.h"

namespace kinora::raytrace {
namespace {

// The samples that parts first to end - 1 of a place draw, `each` a part.
std::vector<dvec2> drawn(uint32_t seed, uint32_t who, uint32_t parts, uint32_t each,
                         uint32_t step = 1) {
    std::vector<dvec2> samples;
    for (uint32_t part = 0; part < parts; part += step) {
        const SampleSeries own = series_of({seed, part, true}, who);
        for (uint32_t k = 0; k < each; ++k)
            samples.push_back(stratified_sample(own.part * each + k, own.seed));
    }
    return samples;
}

// Of a (0, 2)-sequence: each box of area 1/n that is a power of two wide has one of n samples.
TEST(Series, PartsOfAPixelAreOneStratifiedSet) {
    for (uint32_t seed : {1u, 77u, 0x9e3779b9u})
        for (uint32_t parts : {1u, 4u, 16u, 64u})
            for (uint32_t each : {1u, 4u, 16u}) {
                const std::vector<dvec2> samples = drawn(seed, 5, parts, each);
                const auto n = uint32_t(samples.size());
                for (uint32_t columns = 1; columns <= n; columns *= 2) {
                    std::set<uint32_t> boxes;
                    for (const dvec2& s : samples)
                        boxes.insert(uint32_t(s.x * columns) * (n / columns) +
                                     uint32_t(s.y * (n / columns)));
                    ASSERT_EQ(boxes.size(), n) << parts << ' ' << each << ' ' << columns;
                }
            }
}

// Where a surface fills every other sample of a pixel, what these draw has the mean of all.
TEST(Series, ASubsetOfPartsIsNoPattern) {
    constexpr uint32_t kSeeds = 2000, kParts = 16;
    double squares = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        double sum = 0;
        for (const dvec2& s : drawn(hash(seed), 3, kParts, 1, 2)) sum += s.x;
        squares += std::pow(sum / (kParts / 2) - 0.5, 2);
    }
    // Eight numbers drawn alone: 1 / (12 * 8).
    EXPECT_LT(squares / kSeeds, 1.2 / (12 * 8));
}

TEST(Series, ThoseWhoDrawSideBySideDrawOtherNumbers) {
    double product = 0, square = 0;
    for (uint32_t seed = 0; seed < 500; ++seed) {
        const auto a = drawn(hash(seed), 1, 16, 1), b = drawn(hash(seed), 2, 16, 1);
        for (size_t k = 0; k < a.size(); ++k) {
            product += (a[k].x - 0.5) * (b[k].x - 0.5);
            square += (a[k].x - 0.5) * (a[k].x - 0.5);
        }
    }
    EXPECT_LT(std::abs(product / square), 0.05);
}

// Hits of nested rays, and points with numbers of their own, have whole sequences.
TEST(Series, OthersBeginAtTheFirstSample) {
    const SampleSeries own = series_of({42, 0, false}, 9);
    EXPECT_EQ(own.part, 0u);
    EXPECT_EQ(own.seed, hash(42, 9));
}

TEST(Series, CameraHitsOfAPixelShareOne) {
    const uint32_t x[] = {3, 3, 4}, y[] = {5, 5, 5}, sample[] = {0, 7, 7}, layer[] = {0, 0, 0};
    HitBatch hits{};
    hits.pixel_x = x, hits.pixel_y = y, hits.sample = sample, hits.layer = layer;
    const SampleSeries first = kinora::series_of(hits, 0, 1),
                       second = kinora::series_of(hits, 1, 1);
    EXPECT_EQ(first.seed, second.seed);
    EXPECT_EQ(second.part, 7u);
    EXPECT_TRUE(second.shared);
    EXPECT_NE(kinora::series_of(hits, 2, 1).seed, first.seed);
    EXPECT_NE(kinora::series_of(hits, 0, 2).seed, first.seed);
    hits.depth = 1;
    EXPECT_FALSE(kinora::series_of(hits, 1, 1).shared);
    EXPECT_NE(kinora::series_of(hits, 0, 1).seed, kinora::series_of(hits, 1, 1).seed);
}

}  // namespace
}  // namespace kinora::raytrace
