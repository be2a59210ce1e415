// tests/raytrace/film_test.cpp: pixel filters integrate to one, samples are stratified.
#include "raytrace/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "raytrace/sampling.h"

namespace kinora::raytrace {
namespace {

// Mean of x^2 over the filter, by a fine sum of its definition.
double second_moment(const PixelFilter& filter) {
    double sum = 0, weight = 0;
    for (int i = 0; i < 200000; ++i) {
        double x = (i + 0.5) / 100000 - 1, w = filter.density(x);
        sum += w * x * x;
        weight += w;
    }
    return sum / weight * filter.width * filter.width / 4;
}

TEST(PixelFilter, SamplesFollowTheDensity) {
    for (const PixelFilter& filter : pixel_filters()) {
        FilterSampler sampler(filter);
        constexpr int n = 100000;
        double mean = 0, square = 0, last = -1e9;
        for (int i = 0; i < n; ++i) {
            double x = sampler.offset((i + 0.5) / n);
            EXPECT_GE(x, last);
            EXPECT_LE(std::abs(x), filter.width / 2);
            last = x;
            mean += x / n;
            square += x * x / n;
        }
        EXPECT_NEAR(mean, 0, 1e-6) << filter.name;
        EXPECT_NEAR(square / second_moment(filter), 1, 1e-3) << filter.name;
    }
}

TEST(PixelFilter, BoxIsTheIdentityOverThePixel) {
    FilterSampler box(*find_pixel_filter("box"));
    for (double u : {0.0, 0.1, 0.5, 0.77, 1.0}) EXPECT_NEAR(box.offset(u), u - 0.5, 1e-12);
}

TEST(PixelFilter, WidthScalesTheSupport) {
    const PixelFilter& gaussian = *find_pixel_filter("gaussian");
    FilterSampler narrow(gaussian, 2), wide(gaussian, 4);
    for (double u : {0.01, 0.3, 0.9}) EXPECT_NEAR(wide.offset(u), 2 * narrow.offset(u), 1e-12);
    EXPECT_EQ(find_pixel_filter("no such filter"), nullptr);
}

// (0,2)-sequence: any elementary interval of area 1/n holds one of the first n = 2^k samples.
TEST(Sampling, PowersOfTwoAreStratifiedInEveryElementaryInterval) {
    for (uint32_t seed : {0u, 1u, 12345u})
        for (int log_n : {2, 4, 6, 8})
            for (int log_x = 0; log_x <= log_n; ++log_x) {
                std::set<std::pair<int, int>> cells;
                for (uint32_t i = 0; i < 1u << log_n; ++i) {
                    dvec2 u = stratified_sample(i, seed);
                    ASSERT_GE(u.x, 0);
                    ASSERT_LT(u.x, 1);
                    ASSERT_GE(u.y, 0);
                    ASSERT_LT(u.y, 1);
                    cells.insert(
                        {int(std::ldexp(u.x, log_x)), int(std::ldexp(u.y, log_n - log_x))});
                }
                EXPECT_EQ(cells.size(), size_t(1) << log_n);
            }
}

TEST(Sampling, SeedsGiveUnrelatedPointsWhoseMeanIsTheMiddle) {
    dvec2 mean(0.0);
    double product = 0;
    constexpr int n = 20000;
    for (uint32_t seed = 0; seed < n; ++seed) {
        dvec2 u = stratified_sample(0, hash(seed, 7, 0));
        mean += u / double(n);
        product += (u.x - 0.5) * (u.y - 0.5) / n;
    }
    EXPECT_NEAR(mean.x, 0.5, 0.01);
    EXPECT_NEAR(mean.y, 0.5, 0.01);
    EXPECT_NEAR(product, 0, 0.003);
}

TEST(Film, ResizingClearsAndKeepsTheAovs) {
    Film film(4, 3);
    film.add_aov("z", AovFilter::Nearest);
    film.at(1, 2) = vec4(1.0f);
    film.aovs[0].values[11] = 5;
    film.resize(2, 2);
    EXPECT_EQ(film.rgba.size(), 4u);
    EXPECT_EQ(film.aovs.at(0).values, std::vector<float>(4, 0.0f));
    EXPECT_EQ(film.aovs[0].name, "z");
}

}  // namespace
}  // namespace kinora::raytrace
