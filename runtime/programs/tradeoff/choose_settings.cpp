// runtime/programs/tradeoff/choose_settings.cpp: times and errors of the presets, probed.
#include "runtime/programs/tradeoff/choose_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/picture/compare/flip.h"
#include "runtime/programs/tradeoff/measured.h"
#include "runtime/programs/tradeoff/renders.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

constexpr double kShareOfShot = 0.05, kLeastProbing_ms = 20e3;
constexpr size_t kDraft = 0, kReferencePreset = 3;
constexpr int kFewCost = 1, kMoreCost = 5;  // samples of the two frames that a cost comes from
constexpr int kBiasSamples = 16;
constexpr double kMostBias = 0.25;    // of the error: beyond it better settings are taken
constexpr double kLittleOver = 1.05;  // of the time: a probe is no better than that

// The root of what the square of a difference has beyond that of the noise.
double beyond(double difference, double noise) {
    return std::sqrt(std::max(difference * difference - noise * noise, 0.0));
}

raytrace::Film mean_film(const raytrace::Film& a, const raytrace::Film& b) {
    raytrace::Film mean = a;
    for (size_t i = 0; i < mean.rgba.size(); ++i) mean.rgba[i] = 0.5f * (a.rgba[i] + b.rgba[i]);
    return mean;
}

class Probing {
  public:
    Probing(const SettingsRequest& request, Diagnostics& diagnostics)
        : request_(request),
          trade_{.scene = request.scene, .imported = request.imported, .stop = request.stop},
          renders_(trade_, diagnostics) {
        const auto& frames = request.frames;
        const size_t middle = frames.size() / 2;
        frame_ = {frames[middle].first, frames[middle].second,
                  frames[middle > 0 ? middle - 1 : 0].second, "middle"};
        const double shot_ms = request.target.ms * double(frames.size());
        most_ms_ = std::max(kLeastProbing_ms, kShareOfShot * shot_ms);
    }

    std::optional<ChosenSettings> run(std::string& why_not);

  private:
    bool open(std::string& why_not);
    std::optional<FrameCost> cost_of(const Quality& quality);
    std::optional<ChosenSettings> for_time(std::string& why_not);
    std::optional<ChosenSettings> for_error(std::string& why_not);
    std::optional<MeasuredSettings> measured(std::string& note) const;
    bool render_films(const Quality& quality, std::span<raytrace::Film> films);
    double bias(std::span<const raytrace::Film, 2> films,
                std::span<const raytrace::Film, 4> best) const;
    bool out_of_time() const { return renders_.stopped() || watch_.ms() > most_ms_; }

    const SettingsRequest& request_;
    TradeoffRequest trade_;
    TradeRenders renders_;
    TradeFrame frame_;
    FrameSettings settings_;
    double most_ms_;
    Stopwatch watch_;
};

// The picture's size is that of the scene at the settings asked for.
bool Probing::open(std::string& why_not) {
    PosedScene scene = renders_.build(request_.scene.quality);
    if (!scene) {
        why_not = "the scene gives no picture";
        return false;
    }
    settings_ = renders_.settings_of(scene);
    renders_.set_settings(settings_);
    return true;
}

std::optional<FrameCost> Probing::cost_of(const Quality& quality) {
    PosedScene scene = renders_.build(quality);
    if (!scene) return std::nullopt;
    raytrace::Film film;
    // The shorter of two: what else the machine did is not the scene's.
    auto least_ms = [&](int samples) {
        Quality few = quality;
        few.samples_per_pixel = samples;
        TimedFrame once = renders_.frame(scene, few, frame_, 0, film);
        TimedFrame again = renders_.frame(scene, few, frame_, 0, film);
        return once.whole && again.whole ? std::min(once.wall_ms, again.wall_ms) : -1;
    };
    const double few_ms = least_ms(kFewCost), more_ms = least_ms(kMoreCost);
    if (few_ms < 0 || more_ms < 0) return std::nullopt;
    return fit_cost(kFewCost, few_ms, kMoreCost, more_ms);
}

std::optional<MeasuredSettings> Probing::measured(std::string& note) const {
    if (request_.fixed || request_.measured.empty()) return std::nullopt;
    const jit::Target* target = request_.scene.target;
    std::string why_not;
    auto found = measured_settings({.file = request_.measured,
                                    .fingerprint = request_.fingerprint,
                                    .target = target ? target->name : jit::best_target().name,
                                    .threads = thread_count(),
                                    .pixels = double(settings_.width) * settings_.height,
                                    .wanted = request_.target},
                                   why_not);
    if (!found) note = fmt::format("; '{}' {}", request_.measured, why_not);
    return found;
}

// The best preset whose own samples fit, else draft; the samples fill the time.
std::optional<ChosenSettings> Probing::for_time(std::string& why_not) {
    const double ms = request_.target.ms;
    ChosenSettings chosen;
    auto fits = [&](const Quality& quality, int samples, const std::string& from) {
        std::optional<FrameCost> cost = cost_of(quality);
        if (!cost) return false;
        const double least_ms = cost->at(samples);
        if (samples == 1 && least_ms > kLittleOver * ms)
            why_not = fmt::format(
                "a frame of {}x{} pixels takes {:.3g} ms with one sample and the settings of {}: "
                "make the pictures smaller (--scale) or the time longer",
                settings_.width, settings_.height, least_ms, from);
        if (least_ms > (samples == 1 ? kLittleOver : 1) * ms) return false;
        chosen.quality = quality;
        chosen.cost = *cost;
        chosen.from = from;
        return true;
    };
    if (auto row = measured(chosen.said); row)
        if (fits(row->quality, 1, fmt::format("{} of {}", row->name, request_.measured)))
            return chosen;
    if (request_.fixed) {
        if (!fits(request_.scene.quality, 1, "the command line")) return std::nullopt;
        return chosen;
    }
    if (!fits(qualities()[kDraft], 1, qualities()[kDraft].name)) return std::nullopt;
    for (const Quality& preset : qualities().subspan(1))
        if (out_of_time() || !fits(preset, preset.samples_per_pixel, preset.name)) break;
    why_not.clear();
    return chosen;
}

// Each with a seed of its own: 1, 2, ...
bool Probing::render_films(const Quality& quality, std::span<raytrace::Film> films) {
    PosedScene scene = renders_.build(quality);
    if (!scene) return false;
    Quality few = quality;
    few.samples_per_pixel = kBiasSamples;
    for (size_t i = 0; i < films.size(); ++i)
        if (!renders_.frame(scene, few, frame_, uint32_t(i + 1), films[i]).whole) return false;
    return true;
}

// The smaller of two bounds. Pictures with the same seeds share what noise the settings leave
// alone: their difference holds all of the bias. Those with other seeds share none: what their
// difference has beyond that of two means with as much noise and the same settings is the bias.
double Probing::bias(std::span<const raytrace::Film, 2> films,
                     std::span<const raytrace::Film, 4> best) const {
    const TargetMetric metric = request_.target.metric;
    const raytrace::Film mean = mean_film(films[0], films[1]);
    const double same_seeds = target_error(mean, mean_film(best[0], best[1]), metric);
    const double other_seeds = target_error(mean, mean_film(best[2], best[3]), metric);
    const double noise =
        target_error(mean_film(films[0], best[2]), mean_film(films[1], best[3]), metric);
    return std::min(same_seeds, beyond(other_seeds, noise));
}

// The fastest preset whose settings are wrong by less than a quarter of the error; what is left of
// the error is the noise's. No clock decides: each machine that renders a part of the shot comes to
// the same settings.
std::optional<ChosenSettings> Probing::for_error(std::string& why_not) {
    const double error = request_.target.error;
    ChosenSettings chosen{.noise_target = error};
    chosen.quality = request_.scene.quality;
    chosen.from = "the command line";
    if (auto row = measured(chosen.said); row) {
        chosen.quality = row->quality;
        chosen.fewest_samples = row->quality.samples_per_pixel;
        chosen.from = fmt::format("{} of {}", row->name, request_.measured);
        return chosen;
    }
    if (request_.fixed) {
        chosen.said += "; what these settings get wrong besides noise is not counted";
        return chosen;
    }
    const Quality& reference = qualities()[kReferencePreset];
    chosen.quality = reference;
    chosen.from = reference.name;
    raytrace::Film best[4], films[2];
    if (!render_films(reference, best)) {
        why_not = renders_.stopped() ? "stopped" : "the scene gives no picture";
        return std::nullopt;
    }
    for (const Quality& preset : qualities().first(kReferencePreset)) {
        if (!render_films(preset, films)) break;
        const double wrong = bias(films, best);
        if (wrong > kMostBias * error) continue;
        chosen.quality = preset;
        chosen.noise_target = error - wrong;
        chosen.from = preset.name;
        chosen.said += fmt::format("; these are off by {:.2g} without noise", wrong);
        break;
    }
    return chosen;
}

std::optional<ChosenSettings> Probing::run(std::string& why_not) {
    if (!open(why_not)) return std::nullopt;
    auto chosen = request_.target.ms > 0 ? for_time(why_not) : for_error(why_not);
    if (renders_.stopped()) return std::nullopt;
    if (!chosen && why_not.empty()) why_not = "the scene gives no picture";
    return chosen;
}

PictureView film_view(const raytrace::Film& film) {
    return {film.width, film.height, film.rgba};
}

double root_mean_square(const raytrace::Film& a, const raytrace::Film& b) {
    double sum = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double d = double(a.rgba[i][k]) - double(b.rgba[i][k]);
            if (std::isfinite(d)) sum += d * d;
        }
    return std::sqrt(sum / (3 * double(std::max<size_t>(a.rgba.size(), 1))));
}

}  // namespace

double target_error(const raytrace::Film& picture, const raytrace::Film& reference,
                    TargetMetric metric) {
    if (metric == TargetMetric::Rmse) return root_mean_square(picture, reference);
    const Plane flip = ldr_flip(film_view(picture), film_view(reference));
    double sum = 0;
    for (double value : flip.values) sum += value;
    return sum / double(std::max<size_t>(flip.size(), 1));
}

std::optional<ChosenSettings> choose_settings(const SettingsRequest& request,
                                              Diagnostics& diagnostics, std::string& why_not) {
    return Probing(request, diagnostics).run(why_not);
}

}  // namespace kinora
