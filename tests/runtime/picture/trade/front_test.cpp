// tests/runtime/picture/trade/front_test.cpp: Pareto fronts drawn by hand; intervals from binomial
// tables.
#include "runtime/picture/trade/front.h"

#include <gtest/gtest.h>

#include <random>

namespace kinora {
namespace {

// By hand: 1 is slower and worse than 0; 3 is as bad as 2 and slower; 4 is the best and slowest.
TEST(Front, HoldsWhatNothingBeats) {
    std::vector<TradePoint> points{{1, 0.5}, {2, 0.6}, {3, 0.2}, {4, 0.2}, {9, 0.1}};
    EXPECT_EQ(pareto_front(points, 0), (std::vector<bool>{true, false, true, false, true}));
}

// What the noise hides is no gain.
TEST(Front, IgnoresErrorsBelowTheFloor) {
    std::vector<TradePoint> points{{1, 0.5}, {3, 0.2}, {9, 0.1}};
    EXPECT_EQ(pareto_front(points, 0.25), (std::vector<bool>{true, true, false}));
}

TEST(Front, TellsHowMuchSlowerAPointIsThanAsGoodOnes) {
    std::vector<TradePoint> points{{1, 0.5}, {4, 0.2}, {5, 0.2}};
    EXPECT_DOUBLE_EQ(off_front(points[2], points, 0), 0.25);
    EXPECT_DOUBLE_EQ(off_front(points[1], points, 0), 0);
    EXPECT_DOUBLE_EQ(off_front(points[2], points, 0.5), 4);  // the floor makes all equal
}

// Conover, Practical Nonparametric Statistics: the median of 6 lies between the 1st and the 6th
// with 1 - 2 / 64 = 0.969, of 10 between the 2nd and the 9th with 1 - 2 * 11 / 1024 = 0.979.
TEST(MedianInterval, FollowsTheBinomialTable) {
    MedianInterval six = median_interval({6, 1, 5, 2, 4, 3});
    EXPECT_DOUBLE_EQ(six.median, 3.5);
    EXPECT_DOUBLE_EQ(six.low, 1);
    EXPECT_DOUBLE_EQ(six.high, 6);
    EXPECT_NEAR(six.cover, 0.96875, 1e-12);
    MedianInterval ten = median_interval({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    EXPECT_DOUBLE_EQ(ten.low, 2);
    EXPECT_DOUBLE_EQ(ten.high, 9);
    EXPECT_NEAR(ten.cover, 1 - 22.0 / 1024, 1e-12);
}

TEST(MedianInterval, OfFewValuesIsTheirRange) {
    MedianInterval three = median_interval({2, 9, 4});
    EXPECT_DOUBLE_EQ(three.median, 4);
    EXPECT_DOUBLE_EQ(three.low, 2);
    EXPECT_DOUBLE_EQ(three.high, 9);
    EXPECT_NEAR(three.cover, 0.75, 1e-12);
    EXPECT_DOUBLE_EQ(median_interval({7}).cover, 0);
    EXPECT_DOUBLE_EQ(median_interval({}).median, 0);
}

// The true median of numbers from 0 to 1 is inside as often as promised.
TEST(MedianInterval, HoldsTheMedianAsOftenAsItSays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    int held = 0;
    constexpr int kTrials = 4000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> values(15);
        for (double& value : values) value = uniform(random);
        MedianInterval interval = median_interval(values);
        held += interval.low <= 0.5 && 0.5 <= interval.high;
    }
    EXPECT_GT(double(held) / kTrials, 0.945);
}

}  // namespace
}  // namespace kinora
