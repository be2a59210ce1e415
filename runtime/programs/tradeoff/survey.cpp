// runtime/programs/tradeoff/survey.cpp: each variant in a few small frames beside its base.
#include "runtime/programs/tradeoff/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "runtime/base/stats.h"

namespace kinora {

namespace {

constexpr int kSurveyWidth = 32;  // pixels
constexpr int kSurveySamples = 4;
constexpr size_t kPreviewVariant = 1, kFinalVariant = 2;
constexpr double kLightest = 0.1, kHeaviest = 4;  // more is the clock's fault

struct SmallFrame {
    raytrace::Film film;
    TimedFrame timed;
};

bool same_frame(const SmallFrame& a, const SmallFrame& b) {
    return a.timed.whole && b.timed.whole && a.timed.work == b.timed.work &&
           a.film.rgba.size() == b.film.rgba.size() &&
           std::memcmp(a.film.rgba.data(), b.film.rgba.data(), a.film.rgba.size() * sizeof(vec4)) ==
               0;
}

// Whether equal pictures and counts mean that the setting does nothing.
bool may_be_same(const Variant& variant) {
    return variant.knob && is_built_in(*variant.knob) && variant.knob->stage != "trace";
}

class Survey {
  public:
    Survey(TradeRenders& renders, const SurveyRequest& request)
        : renders_(renders), request_(request) {
        const double scale = std::min(1.0, double(kSurveyWidth) / request.width);
        width_ = std::max(1, int(request.width * scale));
        height_ = std::max(1, int(request.height * scale));
        renders.set_size(width_, height_);
    }

    std::vector<SurveyedVariant> run() {
        std::vector<SurveyedVariant> found(request_.variants.size());
        preview_ = frames_of(*request_.preview_scene, request_.variants[kPreviewVariant].quality);
        final_ = frames_of(*request_.final_scene, request_.variants[kFinalVariant].quality);
        found[kPreviewVariant].weight = weight_of(preview_);
        for (size_t v = 0; v < found.size(); ++v) {
            if (renders_.stopped() || watch_.ms() > request_.most_ms) break;
            if (v != kPreviewVariant && v != kFinalVariant)
                found[v] = look_at(request_.variants[v]);
        }
        return found;
    }

    std::string how() const {
        return fmt::format("{}x{} pixels with {} samples", width_, height_, kSurveySamples);
    }

  private:
    std::vector<SmallFrame> frames_of(PosedScene& scene, Quality quality) {
        quality.samples_per_pixel = kSurveySamples;
        std::vector<SmallFrame> frames;
        for (const TradeFrame& frame : request_.frames) {
            SmallFrame& small = frames.emplace_back();
            small.timed = renders_.frame(scene, quality, frame, 0, small.film);
        }
        return frames;
    }

    double weight_of(const std::vector<SmallFrame>& frames) const {
        double own = 0, base = 0;
        for (size_t f = 0; f < frames.size(); ++f) {
            own += frames[f].timed.cpu_ms;
            base += final_[f].timed.cpu_ms;
        }
        return base > 0 ? std::clamp(own / base, kLightest, kHeaviest) : 1;
    }

    SurveyedVariant look_at(const Variant& variant) {
        const bool of_preview = variant.base == kPreviewVariant;
        const std::vector<SmallFrame>& base = of_preview ? preview_ : final_;
        SurveyedVariant found{.same = false, .weight = weight_of(base)};
        if (variant.knob && !is_built_in(*variant.knob)) return found;
        PosedScene scene = renders_.build(variant.quality);
        if (!scene) return found;
        const std::vector<SmallFrame> own = frames_of(scene, variant.quality);
        found.weight = weight_of(own);
        found.same = may_be_same(variant) && std::ranges::equal(own, base, same_frame);
        return found;
    }

    TradeRenders& renders_;
    const SurveyRequest& request_;
    Stopwatch watch_;
    int width_ = 0, height_ = 0;
    std::vector<SmallFrame> preview_, final_;
};

}  // namespace

std::vector<SurveyedVariant> survey_variants(TradeRenders& renders, const SurveyRequest& request,
                                             std::string& how) {
    Survey survey(renders, request);
    how = survey.how();
    return survey.run();
}

}  // namespace kinora
