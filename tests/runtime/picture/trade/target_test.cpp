// tests/runtime/picture/trade/target_test.cpp: a pace that keeps its word on machines made up here;
// noise that falls by known laws.
#include "runtime/picture/trade/target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace kinora {
namespace {

TEST(Target, ReadsErrors) {
    auto flip = parse_target_error("0.01");
    ASSERT_TRUE(flip);
    EXPECT_EQ(flip->error, 0.01);
    EXPECT_EQ(flip->metric, TargetMetric::Flip);
    EXPECT_EQ(parse_target_error("rmse:0.5")->metric, TargetMetric::Rmse);
    EXPECT_EQ(target_text(*parse_target_error("rmse:0.5")), "--target-error rmse:0.5");
    EXPECT_EQ(target_text({.ms = 25}), "--target-ms 25");
    for (const char* wrong : {"", "0", "1", "-0.1", "flip", "flip:", "psnr:0.1", "0.1x", "nan"})
        EXPECT_FALSE(parse_target_error(wrong)) << wrong;
}

TEST(Target, CostsAreALineThroughTwoFrames) {
    FrameCost cost = fit_cost(1, 5, 5, 13);
    EXPECT_DOUBLE_EQ(cost.sample_ms, 2);
    EXPECT_DOUBLE_EQ(cost.fixed_ms, 3);
    EXPECT_DOUBLE_EQ(cost.at(10), 23);
    // A clock that ran backwards still gives a cost that grows with samples.
    EXPECT_DOUBLE_EQ(fit_cost(1, 9, 4, 8).sample_ms, 2);
}

// The mean of frames 9 to 48 of a machine that takes `ms` of (frame, samples).
double mean_of_a_shot(FramePace pace, const std::function<double(int, int)>& ms) {
    double sum = 0;
    for (int frame = 1; frame <= 48; ++frame) {
        const int samples = pace.samples();
        const double took = ms(frame, samples);
        if (frame > 8) sum += took / 40;
        pace.took(samples, took);
    }
    return sum;
}

TEST(Pace, KeepsTheMeanWithinATenth) {
    std::mt19937 random(3);
    std::lognormal_distribution<double> noise(0, 0.15);
    struct Machine {
        const char* what;
        std::function<double(int, int)> ms;
    };
    const Machine machines[] = {
        {"as probed", [](int, int n) { return 4 + 2.0 * n; }},
        {"half as fast as probed", [](int, int n) { return 8 + 4.0 * n; }},
        {"three times as fast", [](int, int n) { return (4 + 2.0 * n) / 3; }},
        {"all of it samples", [](int, int n) { return 3.0 * n; }},
        {"noisy", [&](int, int n) { return (4 + 2.0 * n) * noise(random); }},
        {"a scene that gets twice as costly",
         [](int frame, int n) { return 4 + 2.0 * n * (1 + frame / 48.0); }},
        {"a cut to a shot of half the cost",
         [](int frame, int n) { return frame < 24 ? 4 + 2.0 * n : 2.0 + n; }},
        {"samples too coarse for the time", [](int, int n) { return 3 + 13.0 * n; }},
    };
    for (const Machine& machine : machines)
        for (double target : {25.0, 100.0})
            EXPECT_NEAR(mean_of_a_shot(FramePace(target, {4, 2}), machine.ms) / target, 1, 0.1)
                << machine.what << " at " << target << " ms";
}

TEST(Pace, HasOneSampleAtLeast) {
    FramePace pace(1, {50, 10});
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(pace.samples(), 1);
        pace.took(1, 60);
    }
}

// Pairs of pictures whose noise is exactly c samples^-fall, as the renderer makes them.
int samples_found(double c, double fall, double error, TargetMetric metric, int* spent = nullptr) {
    const double apart = std::pow(2, 0.5 * (metric == TargetMetric::Rmse ? 1 : 0.7));
    std::vector<NoiseLevel> levels;
    while (int next = next_noise_level(levels, error, metric)) {
        levels.push_back({next, apart * c * std::pow(next, -fall)});
        if (spent) *spent += 2 * next;
    }
    return samples_for_error(levels, error, metric);
}

TEST(Noise, GetsTheSamplesThatItsLawAsksFor) {
    for (TargetMetric metric : {TargetMetric::Flip, TargetMetric::Rmse})
        for (double fall : {0.3, 0.4, 0.5})
            for (double error : {0.05, 0.02, 0.01}) {
                const double c = 0.1;
                const int found = samples_found(c, fall, error, metric);
                // 1.5 c n^-s = error, solved for n.
                const double wanted = std::pow(1.5 * c / error, 1 / fall);
                EXPECT_NEAR(found, std::max(wanted, 4.0), 1.01) << fall << " " << error;
            }
}

// A law that is faster than the root of samples is not trusted: more are taken than it asks for.
TEST(Noise, FallsWithTheRootOfSamplesAtMost) {
    for (double error : {0.05, 0.02, 0.01}) {
        const double wanted = std::max(4.0, std::pow(1.5 * 0.1 / error, 1 / 0.75));
        const int found = samples_found(0.1, 0.75, error, TargetMetric::Rmse);
        EXPECT_GE(found, wanted) << error;
        EXPECT_LE(found, 3 * wanted) << error;
    }
}

// A law that gets slower with samples, as FLIP's: the last pair is near enough to see it.
TEST(Noise, OfALawThatSlowsDownKeepsTheMargin) {
    auto law = [](int n) { return n < 16 ? 0.1 * std::pow(n, -0.6) : 0.0436 * std::pow(n, -0.3); };
    for (double error : {0.03, 0.02, 0.015}) {
        std::vector<NoiseLevel> levels;
        while (int next = next_noise_level(levels, error, TargetMetric::Rmse))
            levels.push_back({next, std::sqrt(2) * law(next)});
        EXPECT_LE(law(samples_for_error(levels, error, TargetMetric::Rmse)), error) << error;
    }
}

TEST(Noise, IsEstimatedByHalfOfTheSamplesOrLess) {
    for (double error : {0.004, 0.002}) {
        int spent = 0;
        const int found = samples_found(0.1, 0.5, error, TargetMetric::Rmse, &spent);
        ASSERT_GT(found, 1000);
        EXPECT_LT(spent, 0.5 * found) << error;
    }
}

TEST(Noise, OfAPictureWithoutAnyTakesTheFewest) {
    EXPECT_EQ(samples_found(0, 0.5, 0.01, TargetMetric::Flip), kFewestSamples);
    EXPECT_EQ(samples_found(1e-4, 0.5, 0.01, TargetMetric::Flip), kFewestSamples);
}

TEST(Noise, NeverAsksForMoreThanTheOptionTakes) {
    std::vector<NoiseLevel> levels{{4, 1}, {16, 1}};
    EXPECT_EQ(samples_for_error(levels, 1e-9, TargetMetric::Rmse), 1 << 20);
}

}  // namespace
}  // namespace kinora
