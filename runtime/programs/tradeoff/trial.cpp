// runtime/programs/tradeoff/trial.cpp: one frame, small, with few samples.
#include "runtime/programs/tradeoff/trial.h"

#include <algorithm>

#include "runtime/base/stats.h"
#include "runtime/compare/errors.h"
#include "runtime/trade/knobs.h"

namespace kinora {

namespace {

constexpr int kTrialWidth = 32;  // pixels
constexpr int kFewTrialSamples = 1, kMoreTrialSamples = 5;

// Of one sample of one pixel.
double sample_ms(TradeRenders& renders, Scene& scene, const Quality& quality,
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

TrialCosts trial_costs(TradeRenders& renders, Scene& final_scene, Scene& reference_scene,
                       const TradeFrame& frame, int width, int height) {
    const Quality &preview = *find_quality("preview"), &final_quality = *find_quality("final");
    TrialCosts costs;
    const double scale = std::min(1.0, double(kTrialWidth) / width);
    renders.set_size(std::max(1, int(width * scale)), std::max(1, int(height * scale)));
    costs.sample = sample_ms(renders, final_scene, final_quality, frame);
    costs.reference_sample = sample_ms(renders, reference_scene, *find_quality("reference"), frame);
    Stopwatch watch;
    renders.pose(final_scene, frame.before);
    renders.pose(final_scene, frame.time);
    costs.frame = watch.restart();
    raytrace::Film a, b;
    renders.centres(final_scene, final_quality, frame, a);
    renders.frame(final_scene, preview, frame, 1, b);
    watch.restart();
    picture_errors(trial_view(a), trial_view(b));
    costs.errors_pixel = watch.ms() / double(a.rgba.size());
    return costs;
}

}  // namespace kinora
