// runtime/programs/tradeoff/trial.cpp: one frame, small, with few samples.
#include "runtime/programs/tradeoff/trial.h"

#include <algorithm>

#include "runtime/base/stats.h"
#include "runtime/picture/compare/errors.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

constexpr int kTrialWidth = 32;  // pixels
constexpr int kFewTrialSamples = 1, kMoreTrialSamples = 5;
constexpr double kLargeTrialShare = 0.04;  // of the budget

// Of one sample of one pixel.
double sample_ms(TradeRenders& renders, PosedScene& scene, const Quality& quality,
                 const TradeFrame& frame) {
    raytrace::Film film;
    auto render = [&](int samples) {
        Quality few = quality;
        few.samples_per_pixel = samples;
        return renders.frame(scene, few, frame, 0, film).wall_ms;
    };
    render(kFewTrialSamples);  // reads textures, compiles what is left
    const double less = render(kFewTrialSamples), more = render(kMoreTrialSamples);
    return std::max(more - less, 0.1 * more) /
           ((kMoreTrialSamples - kFewTrialSamples) * double(film.rgba.size()));
}

PictureView trial_view(const raytrace::Film& film) {
    return {film.width, film.height, film.rgba};
}

}  // namespace

TrialCosts trial_costs(TradeRenders& renders, const TrialRequest& request) {
    const Quality &preview = *find_quality("preview"), &final_quality = *find_quality("final"),
                  &reference = *find_quality("reference");
    const TradeFrame& frame = request.frame;
    TrialCosts costs;
    auto sample_costs = [&](int width, int height) {
        renders.set_size(width, height);
        costs.sample = sample_ms(renders, request.final_scene, final_quality, frame);
        costs.reference_sample = sample_ms(renders, request.reference_scene, reference, frame);
    };
    const double scale = std::min(1.0, double(kTrialWidth) / request.width);
    const int width = std::max(1, int(request.width * scale));
    const int height = std::max(1, int(request.height * scale));
    sample_costs(width, height);
    Stopwatch watch;
    renders.pose(request.final_scene, frame.before);
    renders.pose(request.final_scene, frame.time);
    costs.frame = watch.restart();
    raytrace::Film a, b;
    renders.centres(request.final_scene, final_quality, frame, a);
    renders.frame(request.final_scene, preview, frame, 1, b);
    watch.restart();
    picture_errors(trial_view(a), trial_view(b));
    costs.errors_pixel = watch.ms() / double(a.rgba.size());
    const double samples = kFewTrialSamples * 2 + kMoreTrialSamples;
    const double large_ms =
        samples * double(request.width) * request.height * (costs.sample + costs.reference_sample);
    if (width < request.width && large_ms < kLargeTrialShare * request.budget_ms)
        sample_costs(request.width, request.height);
    return costs;
}

}  // namespace kinora
