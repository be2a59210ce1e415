// tests/runtime/picture/shading/rays/budget_test.cpp: budgets of points, without a grid.
#include "runtime/picture/shading/rays/budget.h"

#include <gtest/gtest.h>

namespace kinora {
namespace {

struct Point {
    PointRays rays;
    uint16_t calls = 0;
    uint64_t out = 0, thinned = 0;

    PointBudget budget(float most, uint32_t depth = 0, float share = 1) {
        return {share, depth, 16, most, uint32_t(most), &calls, &rays, &out, most, &thinned};
    }
};

TEST(Budget, TheLastCallIsAnsweredWhole) {
    Point point;
    EXPECT_TRUE(spend_rays(point.budget(10), 9));
    EXPECT_TRUE(spend_rays(point.budget(10), 9));
    EXPECT_EQ(point.rays.shot, 18u);
    EXPECT_FALSE(spend_rays(point.budget(10), 1));
    EXPECT_FALSE(spend_rays(point.budget(10), 1));
    EXPECT_EQ(point.rays.shot, 18u);
    EXPECT_EQ(point.out, 1u);  // points are counted, not calls
    EXPECT_TRUE(ends_loops(point.budget(10)));
}

TEST(Budget, SamplesAreFewerAtHitsOfNestedRays) {
    Point eye, nested;
    EXPECT_EQ(spend_samples(eye.budget(10), 64), 64);
    EXPECT_EQ(spend_samples(eye.budget(10), 64), 0);
    EXPECT_EQ(spend_samples(nested.budget(10, 1), 8), 8);
    EXPECT_EQ(spend_samples(nested.budget(10, 1), 8), 2);
    EXPECT_EQ(spend_samples(nested.budget(10, 1), 8), 0);
}

TEST(Budget, NothingIsCountedWithoutAnAccount) {
    PointBudget budget;
    EXPECT_TRUE(spend_rays(budget, 1 << 20));
    EXPECT_TRUE(refuse_rays(budget, 1 << 20));
    EXPECT_EQ(spend_samples(budget, 64), 64);
    EXPECT_FALSE(ends_loops(budget));
}

TEST(Budget, RefusedCallsEndLoopsToo) {
    Point point;
    for (int call = 0; call < 10; ++call) {
        EXPECT_FALSE(ends_loops(point.budget(10)));
        EXPECT_TRUE(refuse_rays(point.budget(10), 1));
    }
    EXPECT_FALSE(refuse_rays(point.budget(10), 1));
    EXPECT_TRUE(ends_loops(point.budget(10)));
    EXPECT_EQ(point.rays.shot, 0u);
}

// Rays of a tree in which every hit sends so many.
double tree(float share, uint32_t depth, int calls, int samples) {
    Point point;
    double rays = 0;
    for (int c = 0; c < calls; ++c) {
        const float own = ray_share(point.budget(1000, depth, share), samples);
        if (own > 0 && depth < 16) rays += samples * (1 + tree(own, depth + 1, calls, samples));
    }
    return rays;
}

TEST(Budget, SharesEndEveryTree) {
    EXPECT_EQ(tree(1, 0, 1, 1), 16);  // one way is followed to the end
    EXPECT_LT(tree(1, 0, 2, 1), 1000);
    EXPECT_LT(tree(1, 0, 1, 16), 40000);
    EXPECT_GT(tree(1, 0, 1, 16), 16 * 16);
}

TEST(Budget, LaterCallsOfAPointHaveLess) {
    Point point;
    float before = 1;
    for (int call = 0; call < 5; ++call) {
        const float share = ray_share(point.budget(1000), 1);
        EXPECT_LT(share, before);
        before = share;
    }
}

TEST(Budget, FittedSamplesAreNeverNone) {
    for (float share : {1.0f, 0.1f, 0.01f, 1e-6f}) {
        Point point;
        int samples = 64;
        EXPECT_GT(fit_samples(point.budget(1000, 3, share), samples), 0);
        EXPECT_GE(samples, 1);
        EXPECT_EQ(samples == 64, share == 1.0f);
    }
}

// Rays that are to be expected behind a point whose calls take so many samples each.
double paths(float allowance, uint32_t depth, int calls, int samples, uint32_t bounces) {
    Point point;
    double rays = 0;
    for (int c = 0; c < calls; ++c) {
        const AllowedCall call = allow_path(point.budget(allowance, depth), samples, bounces, 0);
        const double behind =
            bounces > 1 ? paths(call.each, depth + 1, calls, samples, bounces - 1) : 0;
        rays += call.samples / double(call.factor) * (1 + behind);
    }
    return rays;
}

TEST(Budget, AllowancesHoldForAllThatFollows) {
    for (uint32_t bounces : {1u, 2u, 4u, 8u})
        for (int samples : {1, 4, 16, 64, 256})
            EXPECT_LE(paths(1000, 0, 1, samples, bounces), 1000) << bounces << " " << samples;
    EXPECT_LE(paths(1000, 0, 3, 16, 4), 1100);  // the least chances of paths come on top
    EXPECT_EQ(paths(1000, 0, 1, 16, 2), 16 + 256);
}

TEST(Budget, PathsThatDoNotFitAreFollowedByChance) {
    for (float number : {0.0f, 0.49f, 0.51f, 0.99f}) {
        Point point;
        const AllowedCall call = allow_path(point.budget(2, 1), 16, 4, number);
        EXPECT_EQ(call.samples, number < 0.5f ? 1 : 0);
        EXPECT_TRUE(call.samples == 0 || call.factor == 2) << call.factor;
        EXPECT_EQ(point.thinned, 1u);
    }
}

TEST(Budget, GatheredSamplesAreSharedByADivisorOfRays) {
    Point eye, nested;
    EXPECT_EQ(allow_rays(eye.budget(10), 64).samples, 64);
    EXPECT_EQ(allow_rays(nested.budget(30, 1), 64).samples, 8);  // half of 30, or less
    EXPECT_EQ(allow_rays(nested.budget(30, 1), 1).samples, 1);
}

TEST(Budget, WhatGoesOnBehindAPointHasTheRestOfItsAllowance) {
    Point point;
    float given = 0;
    for (int call = 0; call < 5; ++call) {
        const AllowedCall own = allow_rays(point.budget(1000), 1);
        given += 1 + own.each;
        EXPECT_NEAR(given + 1000 * point.rays.kept, 1000, 1e-2);
    }
}

}  // namespace
}  // namespace kinora
