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
    in.combinations = 0;
    return in;
}

// By hand, of a frame: references 2 * 1024 * 10 ms; variants 10 * 0.64 s a round, and with a third
// of a render of the base before and after six of them.
TEST(Plan, TakesAllWhereThereIsTime) {
    Plan plan = choose_plan(input(1e9));
    EXPECT_TRUE(plan.fits);
    EXPECT_EQ(plan.width, 100);
    EXPECT_EQ(plan.frames, 4u);
    EXPECT_EQ(plan.rounds, 2u);  // eight times: six are sure
    EXPECT_EQ(plan.reference_samples, 1024);
    EXPECT_EQ(plan.combinations, 0u);
    EXPECT_NEAR(plan.reference_ms, 4 * 2 * 1024 * 10, 1e-6);
    EXPECT_NEAR(plan.variants_ms, 4 * 2 * 10 * 640 * 4 / 3.0, 1e-6);
}

// All four frames, eight times each, take 4 * 2 * 10 * n * 13.33 ms of n samples, and the
// references, of 4 n samples at least, 4 * 2 * 4 n * 10 ms: 68 s and 20 s of 64 samples, 17 s and
// 10 s (they have 128 at least) of 16.
TEST(Plan, LowersTheSamplesOfKnobsBeforeFramesAndThePicture) {
    EXPECT_EQ(choose_plan(input(100e3)).final_samples, 0);
    const Plan plan = choose_plan(input(40e3));
    EXPECT_TRUE(plan.fits);
    EXPECT_EQ(plan.width, 100);
    EXPECT_EQ(plan.frames, 4u);
    EXPECT_EQ(plan.final_samples, 16);
    EXPECT_NEAR(plan.variants_ms / double(plan.frames * plan.rounds), 10 * 160 * 4 / 3.0, 1e-6);
    // A variant whose samples are its own keeps them beside a base of fewer.
    PlannedVariant spp = in_plan({.samples = 256, .base_samples = 64, .final_base = true}, plan);
    EXPECT_EQ(spp.samples, 256);
    EXPECT_EQ(spp.base_samples, 16);
    PlannedVariant preview = in_plan({.samples = 4, .base_samples = 4}, plan);
    EXPECT_EQ(preview.base_samples, 4);
}

// One frame of one sample against 64: 2 * 64 * 10 ms, and 10 * 10 ms * 4 / 3.
TEST(Plan, GoesDownToOneSampleBeforeThePictureGetsSmaller) {
    const Plan plan = choose_plan(input(4e3));
    EXPECT_TRUE(plan.fits);
    EXPECT_EQ(plan.width, 100);
    EXPECT_EQ(plan.frames, 1u);
    EXPECT_EQ(plan.final_samples, 1);
    EXPECT_EQ(plan.preview_samples, 1);
    EXPECT_EQ(plan.reference_samples, 64);
}

TEST(Plan, KeepsItsPromises) {
    for (double budget : {1e3, 3e3, 1e4, 5e4, 1e5, 2e5, 1e6}) {
        PlanInput in = input(budget);
        in.used_ms = 0.1 * budget;
        in.combinations = 24;
        in.sample_settings = {1, 4, 16, 64, 256, 1024};
        Plan plan = choose_plan(in);
        if (!plan.fits) continue;
        EXPECT_LE(plan.reference_ms, 0.4 * budget);
        EXPECT_LE(in.used_ms + plan.reference_ms + plan.variants_ms, budget);
        EXPECT_GE(plan.reference_samples, 64);
        // Several frames, or as many times that an interval has three values.
        EXPECT_TRUE(plan.frames * plan.rounds >= kLeastTimes || plan.frames == 1);
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

// Of 1, 4, 16 and 64 samples the mean is 22: 24 such combinations are 4 * 2 * 24 * (220 + 213) ms.
TEST(Plan, CombinesSettingsInWhatIsLeft) {
    PlanInput in = input(1e9);
    in.combinations = 24;
    in.sample_settings = {1, 4, 16, 64, 256, 1024};
    const Plan all = choose_plan(in), none = choose_plan(input(1e9));
    EXPECT_EQ(all.combinations, 24u);
    EXPECT_NEAR(all.variants_ms - none.variants_ms, 4 * 2 * 24 * (220 + 640 / 3.0), 1);
    in.budget_ms = 100e3;
    const Plan some = choose_plan(in);
    EXPECT_LT(some.combinations, 24u);
    EXPECT_LE(some.reference_ms + some.variants_ms, 90e3);
}

TEST(Plan, LeavesOutVariantsThatTheReferenceCannotJudge) {
    PlanInput in = input(1e9);
    const PlannedVariant many{.samples = 512, .base_samples = 64};
    const Plan plan = choose_plan(in);
    EXPECT_TRUE(is_beyond_reference(many, plan));
    EXPECT_EQ(variant_ms(in, plan, many), 0);
    const PlannedVariant quarter{.samples = 256, .base_samples = 64};
    EXPECT_FALSE(is_beyond_reference(quarter, plan));
    // It is rendered once a frame, and a preset as often as an interval needs.
    EXPECT_EQ(rounds_of(quarter, plan), 1u);
    EXPECT_EQ(rounds_of({.samples = 1024, .base_samples = 4, .preset = true}, plan), 2u);
}

TEST(Plan, CountsWhatVariantsWeigh) {
    PlanInput in = input(1e9);
    const Plan plan = choose_plan(in);
    const double usual = variant_ms(in, plan, in.variants[0]);
    PlannedVariant light = in.variants[0], same = light;
    light.weight = 0.25;  // of the render itself: its part is three of four
    EXPECT_NEAR(variant_ms(in, plan, light) / usual, 0.25 * 0.75 + 0.25, 1e-12);
    same.same = true;
    EXPECT_EQ(variant_ms(in, plan, same), 0);
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
