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
    bool final_base = false;            // the base is `final`, else `preview`
    bool follows = false;               // its samples are the base's, which a plan may lower
    bool preset = false;                // rendered more often, and never left out
    bool same = false;                  // as its base: costs nothing
    double weight = 1;                  // what its sample takes, to one of `final`
    double base_weight = 1;             // likewise of its base
};

struct PlanInput {
    int width = 0, height = 0;  // as asked for
    size_t frames = 1;          // most
    double budget_ms = 0;       // all of it
    double used_ms = 0;         // up to now
    TrialCosts costs;
    std::vector<PlannedVariant> variants{};  // without combinations
    std::vector<int> sample_settings{};      // of --spp: what combinations choose from
    size_t combinations = 24;                // most
    int reference_samples = 1024;            // most
};

inline constexpr double kReferenceShare = 0.4;  // of the budget, at most
inline constexpr int kLeastSamplesOfReference = 64;
inline constexpr size_t kSureTimes = 6;   // of each variant, frames times rounds: 95 % intervals
inline constexpr size_t kLeastTimes = 3;  // where that takes too long; 1 if even that does
inline constexpr int kDearSamples = 64;   // with more a variant is rendered once a frame
inline constexpr int kDearRatio = 4;      // likewise with so many times the base's
inline constexpr size_t kVariantsBetweenBases = 6;

struct Plan {
    int width = 0, height = 0;
    size_t frames = 1;
    size_t rounds = 1, preset_rounds = 1;
    int final_samples = 0, preview_samples = 0;  // of the bases of knobs; 0: their own
    int reference_samples = 64;
    size_t combinations = 0;
    int combination_samples = 64;              // most
    double reference_ms = 0, variants_ms = 0;  // estimated; the latter with combinations
    double least_ms = 0;  // estimated: the references and presets alone, each once
    bool fits = false;    // else some variants will not be measured
};

// The largest picture; then the most frames; then intervals that are sure; then the most samples
// of knobs; then the most samples of the reference that fit. Combinations take what is left. Where
// not even the smallest fits, the largest picture that takes little longer.
Plan choose_plan(const PlanInput& input);
// The variant's samples, and its base's, in that plan.
PlannedVariant in_plan(const PlannedVariant& variant, const Plan& plan);
// Whether its error could not be told from the reference's: it has over a quarter of its samples.
bool is_beyond_reference(const PlannedVariant& variant, const Plan& plan);
// Whether it is rendered no more often than planned, even where time is left.
bool is_dear(const PlannedVariant& variant);
size_t rounds_of(const PlannedVariant& variant, const Plan& plan);

// What one variant is estimated to take, its part of the base's renders included.
double variant_ms(const PlanInput& input, const Plan& plan, const PlannedVariant& variant);

}  // namespace kinora
