// runtime/programs/tradeoff/plan.cpp: sizes, frames and samples, tried from the largest down.
#include "runtime/programs/tradeoff/plan.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

constexpr double kScales[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125, 0.0625};
constexpr double kReserve = 0.9;  // of the budget that may be planned, of the reference's part too
constexpr int kLeastSide = 16;    // pixels
constexpr double kLittleLonger = 1.25;
constexpr int kReferenceOfManyFrames = 128;  // samples, at least; fewer only for one frame
constexpr int kReferenceRatio = 4;           // its samples to those of final's knobs, at least
// Of the base of final's knobs, where its own are too many: settings of --spp, whose row is the
// base then. 0: its own. Fewer show a knob's time and error as well, beside a base with as many.
constexpr int kFinalSamples[] = {0, 16, 4, 1};
constexpr int kOwnFinalSamples = 64;
constexpr size_t kTimes[] = {kSureTimes, kLeastTimes, 1};

size_t rounds_for(size_t times, size_t frames) {
    return (times + frames - 1) / frames;
}

struct Choice {
    double scale = 1;
    size_t frames = 1, times = 1;
    int final_samples = 0, reference = kLeastSamplesOfReference;
};

double pixels_of(const Plan& plan) {
    return double(plan.width) * double(plan.height);
}

// The mean of the settings of --spp that combinations choose from, against a base of final's.
double combination_ms(const PlanInput& in, const Plan& plan) {
    PlannedVariant mean{.samples = 0, .base_samples = plan.combination_samples};
    int count = 0;
    for (int samples : in.sample_settings)
        if (samples <= plan.combination_samples) mean.samples += samples, ++count;
    mean.samples = count > 0 ? (mean.samples + count - 1) / count : plan.combination_samples;
    return variant_ms(in, plan, mean);
}

void add_combinations(const PlanInput& in, Plan& plan) {
    plan.combination_samples = plan.final_samples > 0 ? plan.final_samples : kOwnFinalSamples;
    const double left = kReserve * in.budget_ms - in.used_ms - plan.reference_ms - plan.variants_ms;
    const double each = combination_ms(in, plan);
    if (left <= 0) return;
    plan.combinations = each > 0 ? std::min(in.combinations, size_t(left / each)) : in.combinations;
    plan.variants_ms += double(plan.combinations) * each;
}

Plan planned(const PlanInput& in, const Choice& choice) {
    Plan plan;
    plan.final_samples = choice.final_samples;
    plan.preview_samples = choice.final_samples == 1 ? 1 : 0;
    plan.width =
        std::max(int(std::lround(in.width * choice.scale)), std::min(in.width, kLeastSide));
    plan.height =
        std::max(int(std::lround(in.height * choice.scale)), std::min(in.height, kLeastSide));
    plan.frames = choice.frames;
    plan.rounds = rounds_for(choice.times, choice.frames);
    plan.preset_rounds = choice.times > 1 ? rounds_for(kSureTimes, choice.frames) : 1;
    plan.reference_samples = choice.reference;
    const double pixels = pixels_of(plan);
    plan.reference_ms = 2 * double(plan.frames) *
                        (choice.reference * pixels * in.costs.reference_sample + in.costs.frame);
    int most = 0;
    for (const PlannedVariant& variant : in.variants) {
        if (variant.preset) most = std::max(most, variant.base_samples);
        plan.variants_ms += variant_ms(in, plan, variant);
    }
    plan.least_ms = plan.reference_ms +
                    double(plan.frames) * 3 * (most * pixels * in.costs.sample + in.costs.frame);
    plan.fits = plan.reference_ms <= kReserve * kReferenceShare * in.budget_ms &&
                in.used_ms + plan.reference_ms + plan.variants_ms <= kReserve * in.budget_ms;
    return plan;
}

// The fewest samples of a reference that tells what knobs with so many get wrong.
int least_reference(const PlanInput& in, size_t frames, int final_samples) {
    const int knobs = final_samples > 0 ? final_samples : kOwnFinalSamples;
    const int least = frames > 1 ? kReferenceOfManyFrames : kLeastSamplesOfReference;
    return std::min(std::max(least, kReferenceRatio * knobs), in.reference_samples);
}

// The first choice of that size and number of frames that fits.
bool choose_of(const PlanInput& in, double scale, size_t frames, Plan& chosen) {
    for (size_t times : kTimes) {
        if (times == 1 && frames > 1) continue;
        for (int final_samples : kFinalSamples) {
            if (final_samples == 1 && frames > 1) continue;
            const int least = least_reference(in, frames, final_samples);
            for (int samples = in.reference_samples; samples >= least; samples /= 2) {
                chosen = planned(in, {scale, frames, times, final_samples, samples});
                if (chosen.fits) return true;
            }
        }
    }
    return false;
}

}  // namespace

PlannedVariant in_plan(const PlannedVariant& variant, const Plan& plan) {
    PlannedVariant v = variant;
    const int lowered = v.final_base ? plan.final_samples : plan.preview_samples;
    if (lowered == 0) return v;
    v.base_samples = lowered;
    if (v.follows) v.samples = lowered;
    return v;
}

bool is_beyond_reference(const PlannedVariant& variant, const Plan& plan) {
    return !variant.preset && kReferenceRatio * variant.samples > plan.reference_samples;
}

bool is_dear(const PlannedVariant& variant) {
    return variant.samples > kDearSamples || variant.samples > kDearRatio * variant.base_samples;
}

size_t rounds_of(const PlannedVariant& variant, const Plan& plan) {
    if (variant.preset) return plan.preset_rounds;
    return is_dear(variant) ? 1 : plan.rounds;
}

double variant_ms(const PlanInput& in, const Plan& plan, const PlannedVariant& variant) {
    const PlannedVariant v = in_plan(variant, plan);
    if (v.same || is_beyond_reference(v, plan)) return 0;
    const double pixels = pixels_of(plan);
    auto render = [&](int samples, double weight) {
        return samples * pixels * weight * in.costs.sample + in.costs.frame;
    };
    const double bases = 2.0 / double(kVariantsBetweenBases);
    const double once = render(v.samples, v.weight) + bases * render(v.base_samples, v.base_weight);
    const double of_frame =
        double(rounds_of(v, plan)) * once + pixels * in.costs.errors_pixel + in.costs.frame;
    return in.costs.build + double(plan.frames) * of_frame;
}

Plan choose_plan(const PlanInput& in) {
    for (double scale : kScales)
        for (size_t frames = in.frames; frames >= 1; --frames)
            if (Plan plan; choose_of(in, scale, frames, plan)) {
                add_combinations(in, plan);
                return plan;
            }
    Choice few{.frames = 1,
               .final_samples = std::end(kFinalSamples)[-1],
               .reference = std::min(kLeastSamplesOfReference, in.reference_samples)};
    few.scale = std::end(kScales)[-1];
    const Plan least = planned(in, few);
    for (double scale : kScales) {
        few.scale = scale;
        Plan plan = planned(in, few);
        bool short_of = plan.reference_ms <= kReserve * kReferenceShare * in.budget_ms &&
                        plan.variants_ms <= kLittleLonger * least.variants_ms;
        if (short_of) return plan;
    }
    return least;
}

}  // namespace kinora
