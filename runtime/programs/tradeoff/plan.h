// runtime/programs/tradeoff/plan.h: what of a trade-off fits into a budget of time.
#pragma once

#include <string>
#include <vector>

namespace kinora {

// What a small trial took; milliseconds of wall time on the threads given.
struct TrialCosts {
    double sample = 0;            // one sample of one pixel at `final`
    double reference_sample = 0;  // at `reference`
    double frame = 0;             // what a frame takes besides, posing included
    double build = 0;             // one scene
    double errors_pixel = 0;      // all errors of one pixel
};

struct PlannedVariant {
    int samples = 1, base_samples = 1;  // of its own and of the base that it is compared with
    bool final_base = false;            // the base is `final`, whose samples a plan may lower
    bool follows = false;               // and its own samples with them
};

struct PlanInput {
    int width = 0, height = 0;  // as asked for
    size_t frames = 1;          // most
    double budget_ms = 0;       // all of it
    double used_ms = 0;         // up to now
    TrialCosts costs;
    std::vector<PlannedVariant> variants;
    size_t needed = 0;  // of the variants: the first so many; the rest where there is room
    int reference_samples = 1024;  // most
};

inline constexpr double kReferenceShare = 0.4;  // of the budget, at most
inline constexpr int kLeastSamplesOfReference = 64;
inline constexpr size_t kLeastTimes = 3;  // of each variant: frames times rounds
inline constexpr int kDearSamples = 64;   // with more a variant is rendered once a frame
inline constexpr size_t kVariantsBetweenBases = 4;

struct Plan {
    int width = 0, height = 0;
    size_t frames = 1;
    size_t rounds = 1;
    int final_samples = 0;  // of the base of final's knobs; 0: those of `final`
    int reference_samples = 64;
    double reference_ms = 0, variants_ms = 0;  // estimated
    double least_ms = 0;  // estimated: the references and presets alone, each once
    bool fits = false;    // else some variants will not be measured
};

// The largest picture, then the most samples of final's knobs, then the most frames, then the most
// samples of the reference that fit with the variants that are needed. Where not even the smallest
// does, the largest picture that takes little longer.
Plan choose_plan(const PlanInput& input);
// The variant's samples, and its base's, in that plan.
PlannedVariant in_plan(const PlannedVariant& variant, const Plan& plan);

// What one variant is estimated to take, its part of the base's renders included.
double variant_ms(const PlanInput& input, const Plan& plan, size_t variant);

}  // namespace kinora
