// tests/programs/tradeoff/plan_test.cpp: what fits into a budget, by arithmetic.
#include "runtime/programs/tradeoff/plan.h"

#include <gtest/gtest.h>

namespace kinora {
namespace {

// 10 000 pixels, a microsecond each sample; ten variants of 64 samples against a base of 64.
PlanInput input(double budget_ms) {
    PlanInput in;
    in.width = in.height = 100;
    in.frames = 4;
    in.budget_ms = budget_ms;
    in.costs = {.sample = 1e-3, .reference_sample = 1e-3};
    in.variants.assign(10,
                       {.samples = 64, .base_samples = 64, .final_base = true, .follows = true});
    in.needed = 10;
    return in;
}

// By hand, of a frame: references 2 * 1024 * 10 s; variants 10 * 0.64 s * 1.5 a round.
TEST(Plan, TakesAllWhereThereIsTime) {
    Plan plan = choose_plan(input(1e9));
    EXPECT_TRUE(plan.fits);
    EXPECT_EQ(plan.width, 100);
    EXPECT_EQ(plan.frames, 4u);
    EXPECT_EQ(plan.rounds, 1u);
    EXPECT_EQ(plan.reference_samples, 1024);
    EXPECT_NEAR(plan.reference_ms, 4 * 2 * 1024 * 10, 1e-6);
    EXPECT_NEAR(plan.variants_ms, 4 * 10 * 640 * 1.5, 1e-6);
}

// Of one frame: references of 256 samples 5.12 s; variants of 64 samples 10 * 3 * 0.64 * 1.5 = 28.8
// s, of 16 samples 7.2 s.
TEST(Plan, LowersTheSamplesOfKnobsBeforeThePicture) {
    PlanInput in = input(40e3);
    EXPECT_EQ(choose_plan(in).final_samples, 0);
    in = input(20e3);
    const Plan plan = choose_plan(in);
    EXPECT_TRUE(plan.fits);
    EXPECT_EQ(plan.width, 100);
    EXPECT_EQ(plan.final_samples, 16);
    EXPECT_NEAR(plan.variants_ms / double(plan.frames * plan.rounds), 10 * 160 * 1.5, 1e-6);
    // A variant whose samples are its own keeps them beside a base of fewer.
    PlannedVariant spp = in_plan({.samples = 256, .base_samples = 64, .final_base = true}, plan);
    EXPECT_EQ(spp.samples, 256);
    EXPECT_EQ(spp.base_samples, 16);
    PlannedVariant preview = in_plan({.samples = 4, .base_samples = 4}, plan);
    EXPECT_EQ(preview.base_samples, 4);
}

TEST(Plan, KeepsItsPromises) {
    for (double budget : {1e3, 3e3, 1e4, 5e4, 1e5, 2e5, 1e6}) {
        PlanInput in = input(budget);
        in.used_ms = 0.1 * budget;
        Plan plan = choose_plan(in);
        if (!plan.fits) continue;
        EXPECT_LE(plan.reference_ms, 0.4 * budget);
        EXPECT_LE(in.used_ms + plan.reference_ms + plan.variants_ms, budget);
        EXPECT_GE(plan.frames * plan.rounds, kLeastTimes);
    }
}

TEST(Plan, GrowsWithItsBudget) {
    double before = 0;
    for (double budget : {5e3, 2e4, 8e4, 2e5}) {
        Plan plan = choose_plan(input(budget));
        double work = plan.reference_ms + plan.variants_ms;
        EXPECT_GT(work, before) << budget;
        before = work;
    }
}

TEST(Plan, LeavesOutVariantsOfMoreSamplesThanTheReference) {
    PlanInput in = input(1e9);
    in.variants[0] = {.samples = 2048, .base_samples = 64};
    EXPECT_EQ(variant_ms(in, choose_plan(in), 0), 0);
}

TEST(Plan, SaysWhereNothingFits) {
    Plan plan = choose_plan(input(1));
    EXPECT_FALSE(plan.fits);
    EXPECT_EQ(plan.frames, 1u);
    EXPECT_EQ(plan.reference_samples, kLeastSamplesOfReference);
    EXPECT_GE(plan.width, 1);
    EXPECT_GT(plan.least_ms, 1);  // two references of 256 pixels and 64 samples: 33 ms and more
}

}  // namespace
}  // namespace kinora
