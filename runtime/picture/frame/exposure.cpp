// runtime/picture/frame/exposure.cpp: how bright a scene's pictures should be.
#include "runtime/picture/frame/exposure.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/scene_options.h"

namespace kinora {

namespace {

constexpr double kShare = 0.8, kBright = 0.6;
constexpr int kTimes = 13, kSide = 64;  // pictures and pixels of their longer side
constexpr double kMostStops = 20;

// The largest component of all pixels that are covered and not black, without their coverage.
void add_levels(const raytrace::Film& film, std::vector<float>& levels) {
    for (const vec4& pixel : film.rgba) {
        float most = std::max({pixel.x, pixel.y, pixel.z});
        if (pixel.w > 0 && most > 0) levels.push_back(most / pixel.w);
    }
}

}  // namespace

double auto_exposure(const Scene& scene, const SceneOptions& options, Pose& pose,
                     const FrameSettings& settings, Diagnostics& diagnostics) {
    FrameSettings trial = settings;
    double scale = double(kSide) / std::max({settings.width, settings.height, 1});
    trial.width = std::max(int(std::lround(settings.width * scale)), 1);
    trial.height = std::max(int(std::lround(settings.height * scale)), 1);
    trial.gain = 1;
    trial.most_dice_error = 0;
    trial.integrator.samples_per_pixel = 1;
    trial.integrator.seed = 0;
    trial.integrator.background.reset();
    trial.integrator.nan = raytrace::NanPolicy::Zero;
    double start = options.start_time, length = options.end_time - start;
    raytrace::Film film;
    std::vector<float> levels;
    for (int t = 0; t < (length > 0 ? kTimes : 1); ++t) {
        double time = start + length * t / (kTimes - 1);
        if (render_trial(scene, pose, time, trial, film, diagnostics)) add_levels(film, levels);
    }
    if (levels.empty()) return 0;
    auto at = levels.begin() + ptrdiff_t(kShare * double(levels.size() - 1));
    std::nth_element(levels.begin(), at, levels.end());
    double stops = std::clamp(std::log2(kBright / double(*at)), -kMostStops, kMostStops);
    return std::round(10 * stops) / 10;
}

}  // namespace kinora
