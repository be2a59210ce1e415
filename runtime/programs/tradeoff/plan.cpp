// runtime/programs/tradeoff/plan.cpp: sizes, frames and samples, tried from the largest down.
#include "runtime/programs/tradeoff/plan.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

constexpr double kScales[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125, 0.0625};
constexpr int kGoodReference = 256;  // samples; before it has fewer the picture gets smaller
constexpr double kReserve = 0.9;     // of the budget that may be planned
constexpr int kLeastSide = 16;       // pixels
constexpr double kLittleLonger = 1.25;
// Of the base of final's knobs, where its own are too many: settings of --spp, whose row is the
// base then. 0: its own. Fewer show a knob's time and error as well, beside a base with as many.
constexpr int kFinalSamples[] = {0, 16, 4};

Plan planned(const PlanInput& in, double scale, int final_samples, size_t frames, int reference) {
    Plan plan;
    plan.final_samples = final_samples;
    plan.width = std::max(int(std::lround(in.width * scale)), std::min(in.width, kLeastSide));
    plan.height = std::max(int(std::lround(in.height * scale)), std::min(in.height, kLeastSide));
    plan.frames = frames;
    plan.rounds = (kLeastTimes + frames - 1) / frames;
    plan.reference_samples = reference;
    double pixels = double(plan.width) * double(plan.height);
    plan.reference_ms =
        2 * double(frames) * (reference * pixels * in.costs.reference_sample + in.costs.frame);
    double needed_ms = 0;
    int most = 0;
    for (size_t v = 0; v < in.variants.size(); ++v) {
        most = std::max(most, in.variants[v].base_samples);
        plan.variants_ms += variant_ms(in, plan, v);
        if (v + 1 == in.needed) needed_ms = plan.variants_ms;
    }
    plan.least_ms =
        plan.reference_ms + double(frames) * 3 * (most * pixels * in.costs.sample + in.costs.frame);
    plan.fits = plan.reference_ms <= kReferenceShare * in.budget_ms &&
                in.used_ms + plan.reference_ms + needed_ms <= kReserve * in.budget_ms;
    return plan;
}

}  // namespace

PlannedVariant in_plan(const PlannedVariant& variant, const Plan& plan) {
    PlannedVariant v = variant;
    if (plan.final_samples > 0 && v.final_base) v.base_samples = plan.final_samples;
    if (plan.final_samples > 0 && v.follows) v.samples = plan.final_samples;
    return v;
}

double variant_ms(const PlanInput& in, const Plan& plan, size_t index) {
    const PlannedVariant v = in_plan(in.variants[index], plan);
    if (v.samples > plan.reference_samples) return 0;
    double pixels = double(plan.width) * double(plan.height);
    auto render = [&](int samples) { return samples * pixels * in.costs.sample + in.costs.frame; };
    double bases = 2.0 / double(kVariantsBetweenBases);
    size_t rounds = v.samples > kDearSamples ? 1 : plan.rounds;
    double once = render(v.samples) + bases * render(v.base_samples);
    double of_frame = double(rounds) * once + pixels * in.costs.errors_pixel + in.costs.frame;
    return in.costs.build + double(plan.frames) * of_frame;
}

Plan choose_plan(const PlanInput& in) {
    for (double scale : kScales)
        for (int final_samples : kFinalSamples)
            for (size_t frames = in.frames; frames >= 1; --frames)
                for (int samples = in.reference_samples; samples >= kGoodReference; samples /= 2)
                    if (Plan plan = planned(in, scale, final_samples, frames, samples); plan.fits)
                        return plan;
    const int few = std::min(kLeastSamplesOfReference, in.reference_samples);
    const int fewest = std::end(kFinalSamples)[-1];
    const Plan least = planned(in, std::end(kScales)[-1], fewest, 1, few);
    for (double scale : kScales) {
        Plan plan = planned(in, scale, fewest, 1, few);
        bool short_of = plan.reference_ms <= kReferenceShare * in.budget_ms &&
                        plan.variants_ms <= kLittleLonger * least.variants_ms;
        if (plan.fits || short_of) return plan;
    }
    return least;
}

}  // namespace kinora
