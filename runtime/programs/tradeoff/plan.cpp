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

Plan planned(const PlanInput& in, double scale, size_t frames, int reference) {
    Plan plan;
    plan.width = std::max(int(std::lround(in.width * scale)), std::min(in.width, kLeastSide));
    plan.height = std::max(int(std::lround(in.height * scale)), std::min(in.height, kLeastSide));
    plan.frames = frames;
    plan.rounds = (kLeastTimes + frames - 1) / frames;
    plan.reference_samples = reference;
    double pixels = double(plan.width) * double(plan.height);
    plan.reference_ms =
        2 * double(frames) * (reference * pixels * in.costs.reference_sample + in.costs.frame);
    double needed_ms = 0;
    for (size_t v = 0; v < in.samples.size(); ++v) {
        plan.variants_ms += variant_ms(in, plan, v);
        if (v + 1 == in.needed) needed_ms = plan.variants_ms;
    }
    int most = in.base_samples.empty() ? 0 : *std::ranges::max_element(in.base_samples);
    plan.least_ms =
        plan.reference_ms + double(frames) * 3 * (most * pixels * in.costs.sample + in.costs.frame);
    plan.fits = plan.reference_ms <= kReferenceShare * in.budget_ms &&
                in.used_ms + plan.reference_ms + needed_ms <= kReserve * in.budget_ms;
    return plan;
}

}  // namespace

double variant_ms(const PlanInput& in, const Plan& plan, size_t v) {
    if (in.samples[v] > plan.reference_samples) return 0;
    double pixels = double(plan.width) * double(plan.height);
    auto render = [&](int samples) { return samples * pixels * in.costs.sample + in.costs.frame; };
    double bases = 2.0 / double(kVariantsBetweenBases);
    size_t rounds = in.samples[v] > kDearSamples ? 1 : plan.rounds;
    double once = render(in.samples[v]) + bases * render(in.base_samples[v]);
    double of_frame = double(rounds) * once + pixels * in.costs.errors_pixel + in.costs.frame;
    return in.costs.build + double(plan.frames) * of_frame;
}

Plan choose_plan(const PlanInput& in) {
    for (double scale : kScales)
        for (size_t frames = in.frames; frames >= 1; --frames)
            for (int samples = in.reference_samples; samples >= kGoodReference; samples /= 2)
                if (Plan plan = planned(in, scale, frames, samples); plan.fits) return plan;
    const int few = std::min(kLeastSamplesOfReference, in.reference_samples);
    const Plan least = planned(in, std::end(kScales)[-1], 1, few);
    for (double scale : kScales) {
        Plan plan = planned(in, scale, 1, few);
        bool short_of = plan.reference_ms <= kReferenceShare * in.budget_ms &&
                        plan.variants_ms <= kLittleLonger * least.variants_ms;
        if (plan.fits || short_of) return plan;
    }
    return least;
}

}  // namespace kinora
