// tests/anim/sampler_extremes_test.cpp: the edge cases of docs/numerics.md#keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "anim/sampler.h"
#include "anim/time_cubic.h"
#include "reference.h"
#include "sampler_values.h"

namespace kinora::anim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const Kinds kBezier{Interpolation::Bezier};

TEST(SamplerExtremes, OneKeyIsConstantWhateverTheBehaviour) {
    Numbers times{3}, values{7};
    for (int b = 0; b < static_cast<int>(Behaviour::Count); ++b) {
        auto behaviour = static_cast<Behaviour>(b);
        Sampler s = make_sampler({times, values, 1, kBezier, {}, {}, 1, 1, behaviour, behaviour});
        for (double t : {-1e9, 0.0, 3.0, 8.5, 1e300, kInf, -kInf, kNan}) EXPECT_EQ(at(s, t), 7);
    }
}

TEST(SamplerExtremes, HoldsOutsideTheKeysByDefault) {
    Sampler s = make_sampler({Numbers{1, 2}, Numbers{5, 6}});
    for (double t : {-kInf, -1.0, 1.0, kNan}) EXPECT_EQ(at(s, t), 5);
    for (double t : {2.0, 1e12, kInf}) EXPECT_EQ(at(s, t), 6);
}

TEST(SamplerExtremes, TheRightOfTwoKeysAtOneTimeWins) {
    SamplerRepairs repairs;
    Sampler s = make_sampler({Numbers{0, 1, 1, 2}, Numbers{0, 10, 50, 60}}, &repairs);
    EXPECT_EQ(repairs.duplicate_times, 1u);
    EXPECT_EQ(at(s, 1), 50);
    EXPECT_NEAR(at(s, 1 - 1e-12), 10, 1e-9);
    EXPECT_DOUBLE_EQ(at(s, 1.5), 55);
}

TEST(SamplerExtremes, DuplicateTimesAtTheEndsGiveNoDivisionByZero) {
    Numbers times{0, 0, 1, 1}, values{1, 2, 3, 4}, tangents{0, 0, 0, 0};
    for (int b = 0; b < static_cast<int>(Behaviour::Count); ++b) {
        auto behaviour = static_cast<Behaviour>(b);
        for (int i = 0; i < static_cast<int>(Interpolation::Count); ++i) {
            Kinds kind{static_cast<Interpolation>(i)};
            Sampler s = make_sampler(
                {times, values, 1, kind, tangents, tangents, 1, 1, behaviour, behaviour});
            for (double t : {-0.5, 0.0, 0.5, 1.0, 1.5}) EXPECT_TRUE(std::isfinite(at(s, t)));
            EXPECT_EQ(at(s, 0), i == int(Interpolation::Bspline) ? at(s, 0) : 2);
            EXPECT_EQ(at(s, 1), 4);
        }
    }
}

TEST(SamplerExtremes, UnsortedKeysAreSortedWithTheirTangents) {
    Numbers times{0, 2, 1}, values{0, 20, 10};
    Numbers out{0, 5, 0, 0, 1.5, 30}, in{0, 0, 1.75, 3, 0.5, 6};
    SamplerRepairs repairs;
    Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2}, &repairs);
    EXPECT_EQ(repairs.unsorted_keys, 1u);
    EXPECT_NEAR(at(s, 0.5), reference::bezier_at({0, 0}, {0, 5}, {0.5, 6}, {1, 10}, 0.5), 1e-10);
    EXPECT_NEAR(at(s, 1.6), reference::bezier_at({1, 10}, {1.5, 30}, {1.75, 3}, {2, 20}, 1.6),
                1e-10);
}

TEST(SamplerExtremes, VerticalTangentsStayWithinABillionth) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    Numbers times{0, 1}, values{0, 1}, out{1, 2, 0, 0}, in{0, 0, 0, -1};
    Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2});
    double worst = 0;
    for (int n = 0; n < 20000; ++n) {
        double t = unit(random);
        worst = std::max(
            worst, std::abs(at(s, t) - reference::bezier_at({0, 0}, {1, 2}, {0, -1}, {1, 1}, t)));
    }
    EXPECT_LT(worst, 1e-9);
}

TEST(SamplerExtremes, TheTimeCubicIsSolvedAtEveryCornerOfItsTangents) {
    const double corners[] = {0, 1e-300, 1e-9, 0.3, 0.5, 1 - 1e-9, 1};
    for (double x0 : corners)
        for (double x1 : corners)
            for (double u : {0.0, 1e-300, 1e-12, 0.25, 0.5, 0.9, 1 - 1e-12, 1.0})
                for (double scale : {1.0, 1e-6, 1e9}) {
                    double time[2] = {x0 * scale, x1 * scale};
                    double s = solve_time_cubic(time, scale, u * scale);
                    ASSERT_GE(s, 0);
                    ASSERT_LE(s, 1);
                    ASSERT_NEAR(double(reference::bezier(0, x0, x1, 1, s)), u, 1e-15)
                        << x0 << ' ' << x1 << ' ' << u;
                }
}

TEST(SamplerExtremes, TangentTimesOutsideTheSegmentAreClamped) {
    Numbers times{0, 1}, values{0, 1}, out{1.5, 2, 0, 0}, in{0, 0, -0.5, -1};
    SamplerRepairs repairs;
    Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2}, &repairs);
    EXPECT_EQ(repairs.clamped_tangents, 2u);
    for (double t : {0.2, 0.7})
        EXPECT_NEAR(at(s, t), reference::bezier_at({0, 0}, {1, 2}, {0, -1}, {1, 1}, t), 1e-9);
}

TEST(SamplerExtremes, AMillionKeysAreReadyInLinearTimeAndFoundByHalving) {
    Numbers times, values;
    for (int i = 0; i < 1000000; ++i) {
        times.push_back(i * 0.01 + (i % 7) * 0.001);
        values.push_back(i);
    }
    Sampler s = make_sampler({times, values});
    for (int i : {0, 1, 499999, 765432, 999999}) EXPECT_EQ(at(s, times[size_t(i)]), i);
    EXPECT_NEAR(at(s, (times[500] + times[501]) / 2), 500.5, 1e-9);
}

// A smooth curve over keys 10^-6 s apart, near 0 and near 10^6 s: the double reference, and one ULP
// of the float that a channel writes.
TEST(SamplerExtremes, KeysAMicrosecondApartAreWithinAnUlp) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    for (double from : {0.0, 1e3, 1e6}) {
        Numbers times, values, out, in;
        for (int i = 0; i < 1000; ++i) {
            times.push_back(from + i * 1e-6);
            values.push_back(100 + 50 * std::sin(i * 0.7));
        }
        for (size_t i = 0; i < times.size(); ++i) {
            const double step = 1e-6 / 3;
            out.insert(out.end(), {times[i] + step, values[i] + 5});
            in.insert(in.end(), {times[i] - step, values[i] - 5});
        }
        Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2});
        for (int n = 0; n < 3000; ++n) {
            const size_t i = random() % (times.size() - 1);
            // as far as a double tells times apart there
            const double t = times[i] + (times[i + 1] - times[i]) * unit(random);
            if (t <= times[i] || t >= times[i + 1]) continue;
            const double truth = reference::bezier_at(
                {times[i], values[i]}, {out[2 * i], out[2 * i + 1]}, {in[2 * i + 2], in[2 * i + 3]},
                {times[i + 1], values[i + 1]}, t);
            const float got = float(at(s, t)), want = float(truth);
            ASSERT_LE(std::abs(got - want), std::nextafter(std::abs(want), 1e9f) - std::abs(want))
                << i << " of keys from " << from;
        }
    }
}

TEST(SamplerExtremes, ACurveThatRisesIsMonotone) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int curve = 0; curve < 200; ++curve) {
        double c[4] = {unit(random), unit(random), unit(random), unit(random)};
        std::sort(c, c + 4);  // control values that rise make a curve that rises
        Numbers times{0, 1}, values{c[0], c[3]}, out{unit(random), c[1], 0, 0};
        Numbers in{0, 0, unit(random), c[2]};
        Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2});
        float before = float(c[0]);
        for (int i = 0; i <= 2000; ++i) {
            const float now = float(at(s, i / 2000.0));
            ASSERT_GE(now, before) << "curve " << curve << " at " << i / 2000.0;
            before = now;
        }
    }
}

TEST(SamplerExtremes, KeysThatAreNotFiniteAreDropped) {
    SamplerRepairs repairs;
    Sampler s =
        make_sampler({Numbers{0, kNan, 1, 2, kInf, 3}, Numbers{0, 9, 10, kNan, 9, 30}}, &repairs);
    EXPECT_EQ(repairs.non_finite_keys, 3u);
    EXPECT_EQ(at(s, 2), 20);
    EXPECT_TRUE(make_sampler({Numbers{kNan}, Numbers{1}}).empty());
}

TEST(SamplerExtremes, TimesOfAMillionSecondsKeepTheirAccuracy) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    for (int n = 0; n < 5000; ++n) {
        double t0 = 1e6 + unit(random), t1 = t0 + 1;
        Numbers times{t0, t1}, values{0, 1}, out{t0 + unit(random), 2, 0, 0};
        Numbers in{0, 0, t0 + unit(random), -1};
        Sampler s = make_sampler({times, values, 1, kBezier, in, out, 2, 2});
        double t = t0 + unit(random);
        double expected = reference::bezier_at({t0, 0}, {out[0], 2}, {in[2], -1}, {t1, 1}, t);
        worst = std::max(worst, std::abs(at(s, t) - expected));
    }
    EXPECT_LT(worst, 1e-6);
}

TEST(SamplerExtremes, AnglesTurnAsNumbers) {
    Sampler s = make_sampler({Numbers{0, 1}, Numbers{0, 720}});
    EXPECT_DOUBLE_EQ(at(s, 0.75), 540);
}

TEST(SamplerExtremes, SegmentsWithoutTangentsRunStraight) {
    Numbers times{0, 1, 2}, values{0, 4, 0};
    SamplerRepairs repairs;
    Sampler s = make_sampler({times, values, 1, kBezier}, &repairs);
    EXPECT_EQ(repairs.missing_tangents, 2u);
    EXPECT_DOUBLE_EQ(at(s, 0.25), 1);
    SamplerRepairs bad;
    Numbers nan(3, kNan);
    EXPECT_DOUBLE_EQ(at(make_sampler({times, values, 1, kBezier, nan, nan}, &bad), 0.25), 1);
    EXPECT_EQ(bad.bad_tangents, 4u);
}

TEST(SamplerExtremes, WrongCountsAreCutOffAndCounted) {
    SamplerRepairs repairs;
    Sampler s = make_sampler({Numbers{0, 1, 2}, Numbers{0, 1, 2, 3}, 2}, &repairs);
    EXPECT_EQ(repairs.missing_values, 1u);
    EXPECT_EQ(s.times.size(), 2u);
    SamplerRepairs stride;
    Numbers tangents(14);
    make_sampler({Numbers{0, 1}, Numbers{0, 1}, 1, kBezier, tangents, tangents, 7, 7}, &stride);
    EXPECT_EQ(stride.bad_stride, 1u);
    EXPECT_EQ(stride.missing_tangents, 1u);
    EXPECT_FALSE(SamplerRepairs().any());
    EXPECT_TRUE(stride.any());
}

}  // namespace
}  // namespace kinora::anim
