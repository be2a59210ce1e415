// tests/anim/sampler_test.cpp: every interpolation and behaviour against its definition.
#include "anim/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "reference.h"
#include "sampler_values.h"

namespace kinora::anim {
namespace {

Sampler numbers(const Numbers& times, const Numbers& values, const Kinds& kinds,
                Behaviour pre = Behaviour::Constant, Behaviour post = Behaviour::Constant) {
    return make_sampler({times, values, 1, kinds, {}, {}, 1, 1, pre, post});
}

TEST(Sampler, RepairsAreToldInWords) {
    SamplerRepairs repairs;
    repairs.duplicate_times = 1;
    EXPECT_EQ(to_text(repairs), "");
    repairs.unsorted_keys = 2;
    repairs.bad_stride = 1;
    EXPECT_EQ(to_text(repairs), "2 keys out of order sorted, 1 unfitting stride");
}

TEST(Sampler, SegmentUsesItsLeftKeysInterpolation) {
    Sampler s = numbers(
        {0, 1, 2, 3}, {0, 10, 20, 40},
        {Interpolation::Step, Interpolation::Linear, Interpolation::Step, Interpolation::Linear});
    EXPECT_EQ(at(s, 0.99), 0);
    EXPECT_EQ(at(s, 1), 10);
    EXPECT_EQ(at(s, 1.5), 15);
    EXPECT_EQ(at(s, 2.999), 20);
    EXPECT_EQ(at(s, 3), 40);
}

TEST(Sampler, OneInterpolationServesAllKeysAndNoneMeansLinear) {
    EXPECT_EQ(at(numbers({0, 1, 2}, {0, 4, 0}, {Interpolation::Step}), 1.75), 4);
    EXPECT_EQ(at(numbers({0, 1, 2}, {0, 4, 0}, {}), 1.75), 1);
}

TEST(Sampler, BezierSolvesTheTimeCubic) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    for (int n = 0; n < 20000; ++n) {
        double t0 = unit(random) * 10, t1 = t0 + 0.01 + unit(random), h = t1 - t0;
        Numbers times{t0, t1}, values{unit(random), unit(random)};
        Numbers out{t0 + h * unit(random), 2 * unit(random) - 0.5, 0, 0};
        Numbers in{0, 0, t0 + h * unit(random), 2 * unit(random) - 0.5};
        Sampler s = make_sampler({times, values, 1, Kinds{Interpolation::Bezier}, in, out, 2, 2});
        double t = t0 + h * unit(random);
        double expected = reference::bezier_at({t0, values[0]}, {out[0], out[1]}, {in[2], in[3]},
                                               {t1, values[1]}, t);
        worst = std::max(worst, std::abs(at(s, t) - expected));
    }
    EXPECT_LT(worst, 1e-9);
}

TEST(Sampler, OneDimensionalBezierTangentsAreRelativeWithTimesAtTheThirds) {
    Numbers times{1, 3}, values{5, 9}, out{2, 0}, in{0, -1};
    Sampler s = make_sampler({times, values, 1, Kinds{Interpolation::Bezier}, in, out});
    for (double u : {0.0, 0.1, 0.5, 0.75, 1.0})  // C0 = 5 + 2, C1 = 9 - -1
        EXPECT_NEAR(at(s, 1 + 2 * u), double(reference::bezier(5, 7, 10, 9, u)), 1e-14);
}

TEST(Sampler, OneDimensionalHermiteTangentsAreDerivativesOverTheSegment) {
    Numbers times{1, 3}, values{5, 9}, out{2, 0}, in{0, -1};
    Sampler s = make_sampler({times, values, 1, Kinds{Interpolation::Hermite}, in, out});
    for (double u : {0.0, 0.1, 0.5, 0.75, 1.0})
        EXPECT_NEAR(at(s, 1 + 2 * u), reference::hermite(5, 2, 9, -1, u), 1e-14);
}

TEST(Sampler, TwoDimensionalHermiteTangentsAreAbsolutePoints) {
    Numbers times{0, 1}, values{0, 1}, out{0.1, 2, 0, 0}, in{0, 0, 0.6, 3};
    Sampler hermite =
        make_sampler({times, values, 1, Kinds{Interpolation::Hermite}, in, out, 2, 2});
    for (double t : {0.1, 0.4, 0.9})
        EXPECT_NEAR(at(hermite, t), reference::bezier_at({0, 0}, {0.1, 2}, {0.6, 3}, {1, 1}, t),
                    1e-12);
}

TEST(Sampler, TangentPairsPerComponentAndOneSharedTimeGiveTheSameCurve) {
    Numbers times{0, 2}, values{0, 10, 1, 20};
    Numbers out_pairs{0.3, 5, 0.3, 6, 0, 0, 0, 0}, in_pairs{0, 0, 0, 0, 1.1, 7, 1.1, 8};
    Numbers out_shared{0.3, 5, 6, 0, 0, 0}, in_shared{0, 0, 0, 1.1, 7, 8};
    Kinds bezier{Interpolation::Bezier};
    Sampler pairs = make_sampler({times, values, 2, bezier, in_pairs, out_pairs, 4, 4});
    Sampler shared = make_sampler({times, values, 2, bezier, in_shared, out_shared, 3, 3});
    for (double t : {0.2, 1.0, 1.7}) {
        double a[2], b[2];
        evaluate(pairs, t, 0, a);
        evaluate(shared, t, 0, b);
        EXPECT_EQ(a[0], b[0]);
        EXPECT_EQ(a[1], b[1]);
        EXPECT_NEAR(a[1], reference::bezier_at({0, 10}, {0.3, 6}, {1.1, 8}, {2, 20}, t), 1e-10);
    }
}

TEST(Sampler, CardinalAndBsplineFollowTheirMatrices) {
    Numbers times{0, 1, 2, 3}, values{3, 7, -2, 5};
    Sampler cardinal = numbers(times, values, {Interpolation::Cardinal});
    Sampler bspline = numbers(times, values, {Interpolation::Bspline});
    for (double u : {0.0, 0.25, 0.8}) {
        EXPECT_NEAR(at(cardinal, 1 + u), reference::cardinal(3, 7, -2, 5, u), 1e-14);
        EXPECT_NEAR(at(bspline, 1 + u), reference::bspline(3, 7, -2, 5, u), 1e-14);
    }
    // beyond the ends the end keys continue in a line
    EXPECT_NEAR(at(cardinal, 0.5), reference::cardinal(-1, 3, 7, -2, 0.5), 1e-14);
    EXPECT_NEAR(at(bspline, 2.5), reference::bspline(7, -2, 5, 12, 0.5), 1e-14);
}

TEST(Sampler, CurvesOverKeysOnALineAreThatLine) {
    Numbers times{0, 1, 2, 3}, values{1, 3, 5, 7};
    for (auto kind : {Interpolation::Linear, Interpolation::Cardinal, Interpolation::Bspline})
        for (double t : {0.3, 1.5, 2.9})
            EXPECT_NEAR(at(numbers(times, values, {kind}), t), 1 + 2 * t, 1e-14);
}

TEST(Sampler, ACurveAtRestStaysBitForBit) {
    Numbers times{0, 0.7, 1}, values{0.1, 0.1, 0.1}, zero{0, 0, 0};
    for (int i = 0; i < static_cast<int>(Interpolation::Count); ++i) {
        Kinds kind{static_cast<Interpolation>(i)};
        Sampler s = make_sampler({times, values, 1, kind, zero, zero});
        for (double t = 0; t < 1; t += 0.01) ASSERT_EQ(at(s, t), 0.1) << i;
    }
}

TEST(Sampler, BehavioursExtendTheCurve) {
    Numbers times{1, 2, 3}, values{0, 10, 4};
    auto both = [&](Behaviour b) { return numbers(times, values, {}, b, b); };
    Sampler constant = both(Behaviour::Constant), linear = both(Behaviour::Linear),
            cycle = both(Behaviour::Cycle), relative = both(Behaviour::CycleRelative),
            oscillate = both(Behaviour::Oscillate);
    EXPECT_EQ(at(constant, -5), 0);
    EXPECT_EQ(at(constant, 50), 4);
    EXPECT_DOUBLE_EQ(at(linear, 0.5), -5);
    EXPECT_DOUBLE_EQ(at(linear, 4), -2);
    EXPECT_DOUBLE_EQ(at(cycle, 3.5), 5);
    EXPECT_DOUBLE_EQ(at(cycle, 0.5), 7);  // 2.5 of the round before
    EXPECT_DOUBLE_EQ(at(cycle, 1 + 2 * 1000 + 0.25), 2.5);
    EXPECT_DOUBLE_EQ(at(relative, 3.5), 4 + 5);
    EXPECT_DOUBLE_EQ(at(relative, 5.5), 8 + 5);
    EXPECT_DOUBLE_EQ(at(relative, 0.5), 7 - 4);
    EXPECT_DOUBLE_EQ(at(oscillate, 3.5), 7);
    EXPECT_DOUBLE_EQ(at(oscillate, 5.5), 5);
    EXPECT_DOUBLE_EQ(at(oscillate, 0.5), 5);
}

TEST(Sampler, PreAndPostBehaviourAreTwoThings) {
    Sampler s = numbers({0, 1}, {0, 1}, {}, Behaviour::Linear, Behaviour::Cycle);
    EXPECT_DOUBLE_EQ(at(s, -2), -2);
    EXPECT_DOUBLE_EQ(at(s, 1.25), 0.25);
}

TEST(Sampler, ComponentsAreEvaluatedAlone) {
    Numbers times{0, 1}, values{1, 2, 3, 5, 6, 7};
    Sampler s = make_sampler({times, values, 3});
    double one = 0, two[2];
    evaluate(s, 0.5, 1, std::span(&one, 1));
    evaluate(s, 0.5, 1, two);
    EXPECT_EQ(one, 4);
    EXPECT_EQ(two[1], 5);
}

}  // namespace
}  // namespace kinora::anim
