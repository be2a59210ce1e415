// tests/anim/baked_test.cpp: what curves lose that are sampled, and turns that go straight.
#include "anim/baked.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sampler_values.h"

namespace kinora::anim {
namespace {

// From 0 to 1 in a second, with flat ends: 3 s^2 - 2 s^3.
Sampler ease() {
    Numbers times{0, 1}, values{0, 1}, tangents{0, 0};
    return make_sampler({times, values, 1, Kinds{Interpolation::Hermite}, tangents, tangents});
}

Matrix16 turned(double degrees) {
    const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
    return {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
}

Sampler turn(double degrees) {
    const Matrix16 a = turned(0), b = turned(degrees);
    Numbers times{0, 1}, values(a.begin(), a.end());
    values.insert(values.end(), b.begin(), b.end());
    return make_sampler({.times = times, .values = values, .stride = 16, .kind = SampleKind::Matrix});
}

double degrees_at(const Sampler& sampler, double time) {
    Matrix16 m;
    evaluate(sampler, time, 0, m);
    return std::atan2(m[4], m[0]) * 180 / kPi;
}

TEST(Baked, SamplesHaveTheCurvesValuesAndTheEndsTheKeys) {
    const Sampler curve = ease(), made = baked(curve, {.rate = 8});
    ASSERT_EQ(made.times.size(), 9u);
    for (int k = 0; k <= 8; ++k) EXPECT_EQ(at(made, k / 8.0), at(curve, k / 8.0));
    EXPECT_EQ(at(made, -1), 0);
    EXPECT_EQ(at(made, 2), 1);
}

// A straight piece of h seconds is off by h^2 / 8 times the second derivative, 6 at the ends.
TEST(Baked, ErrorFallsWithTheSquareOfTheRate) {
    const Sampler curve = ease();
    auto worst = [&](double rate) {
        const Sampler made = baked(curve, {.rate = rate});
        double error = 0;
        for (int i = 0; i <= 1000; ++i)
            error = std::max(error, std::abs(at(made, i / 1000.0) - at(curve, i / 1000.0)));
        return error;
    };
    EXPECT_NEAR(worst(10), 6 * 0.01 / 8, 0.15 * 6 * 0.01 / 8);
    EXPECT_NEAR(worst(10) / worst(40), 16, 2);
}

// Between 0 and 60 degrees the numbers' mean is the chord: its length is cos 30.
TEST(Baked, MatricesAreMixedByTheirNumbers) {
    const Sampler made = baked(turn(60), {.rate = 1});
    Matrix16 m;
    evaluate(made, 0.5, 0, m);
    EXPECT_NEAR(std::hypot(m[0], m[4]), std::cos(kPi / 6), 1e-12);
    EXPECT_NEAR(degrees_at(made, 0.5), 30, 1e-9);
    EXPECT_NEAR(degrees_at(baked(turn(60), {.rate = 100}), 0.255), 15.3, 1e-3);
}

TEST(Baked, JumpsAndStraightLinesStay) {
    Numbers times{0, 1, 2}, values{0, 5, 7};
    const Kinds step{Interpolation::Step, Interpolation::Hermite, Interpolation::Step};
    const Sampler jump = make_sampler({times, values, 1, step});
    EXPECT_EQ(baked(jump, {.rate = 30}).times, times);
    EXPECT_EQ(at(baked(jump, {.rate = 30}), 0.99), 0);
    const Sampler line = make_sampler({times, values});
    EXPECT_EQ(baked(line, {.rate = 30}).times, times);
    Numbers twice{0, 1, 1}, two{0, 1, 5};
    const Sampler jumps = make_sampler({twice, two, 1, Kinds{Interpolation::Cardinal}});
    EXPECT_EQ(baked(jumps, {.rate = 30}).times, twice);
}

TEST(Baked, AYearOfSamplesIsNotMade) {
    Numbers times{0, 3e7}, values{0, 1}, flat{0, 0};
    const Sampler slow = make_sampler({times, values, 1, Kinds{Interpolation::Hermite}, flat, flat});
    EXPECT_EQ(baked(slow, {.rate = 30}).times, times);
}

TEST(Baked, NothingStandsForExactCurves) {
    const Animation animation = make_animation({ease(), turn(90)}, {{0, 0, 0}, {1, 0, 1, 16}});
    EXPECT_TRUE(baked(animation, {}).empty());
    const std::vector<Sampler> samplers = baked(animation, {.rate = 4});
    ASSERT_EQ(samplers.size(), 2u);
    std::vector<double> exact(17), rough(17);
    std::vector<uint64_t> changed(1);
    evaluate(animation, 0.1, exact, changed);
    evaluate(animation, 0.1, rough, changed, samplers);
    EXPECT_NEAR(exact[0], 0.028, 1e-12);                      // 3 s^2 - 2 s^3
    EXPECT_NEAR(rough[0], 0.4 * (3 / 16.0 - 2 / 64.0), 1e-12);  // of the value at 1/4
    EXPECT_NE(exact[1], rough[1]);
}

// By hand: a quarter of the chord between 0 and a is at atan2(sin(a/2), 3 + cos(a/2)) of the
// half-angles: twice that of the turn.
TEST(Nlerp, FollowsTheChord) {
    for (double degrees : {15.0, 60.0, 90.0, 120.0, 179.0}) {
        Sampler s = turn(degrees);
        EXPECT_NEAR(degrees_at(s, 0.25), degrees / 4, 1e-9);
        s = baked(s, {.rotation = RotationPath::Nlerp});
        const double half = degrees * kPi / 360;
        const double by_hand = 2 * std::atan2(std::sin(half), 3 + std::cos(half)) * 180 / kPi;
        EXPECT_NEAR(degrees_at(s, 0.25), by_hand, 1e-9) << degrees;
        EXPECT_NEAR(degrees_at(s, 0.5), degrees / 2, 1e-9) << degrees;
        EXPECT_NEAR(degrees_at(s, 1), degrees, 1e-9) << degrees;
    }
}

TEST(Nlerp, TakesTheShortWayAsSlerpDoes) {
    const Quaternion a{1, 0, 0, 0}, b{-std::cos(0.3), 0, 0, -std::sin(0.3)};  // 0.6 about z
    EXPECT_NEAR(nlerp(a, b, 0.5).z, std::sin(0.15), 1e-12);
    for (const Quaternion& half : {Quaternion{0, 1, 0, 0}, Quaternion{0, -1, 0, 0}}) {
        const Quaternion p = nlerp(a, half, 0.5), q = slerp(a, half, 0.5);
        EXPECT_NEAR(p.x, q.x, 1e-12);
        EXPECT_GT(p.x, 0);
    }
}

}  // namespace
}  // namespace kinora::anim
