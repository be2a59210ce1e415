// runtime/programs/render/targeted.cpp: a clock or the noise chooses each frame's samples.
#include "runtime/programs/render/targeted.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

constexpr size_t kFramesToSettle = 8;  // whose times are not counted, where more follow
constexpr uint32_t kFirstPassSeed = 0x7a3;

}  // namespace

TargetedFrames::TargetedFrames(const FrameTarget& target, const ChosenSettings& chosen)
    : target_(target), chosen_(chosen), pace_(target.ms, chosen.cost) {}

std::string TargetedFrames::begin_text() const {
    std::string settings;
    for (const Knob& knob : knobs())
        if (knob.option != "spp")
            settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", knob.option,
                                    knob_text(knob, chosen_.quality));
    std::string samples =
        target_.ms > 0 ? fmt::format("some {} samples a frame ({:.3g} ms and {:.3g} ms a sample)",
                                     pace_.samples(), chosen_.cost.fixed_ms, chosen_.cost.sample_ms)
                       : fmt::format("{} samples a frame and more, by its noise",
                                     std::max(chosen_.fewest_samples, kFewestSamples));
    return fmt::format("{}: settings of {} ({}), {}{}", target_text(target_), chosen_.from,
                       settings, samples, chosen_.said);
}

int TargetedFrames::samples(RenderPass render) {
    return target_.ms > 0 ? pace_.samples() : samples_by_noise(render);
}

// Of the frame alone: its picture does not depend on those before.
int TargetedFrames::samples_by_noise(RenderPass render) {
    std::vector<NoiseLevel> levels;
    while (int next = next_noise_level(levels, chosen_.noise_target, target_.metric)) {
        for (uint32_t pass = 0; pass < 2; ++pass)
            if (!render(next, kFirstPassSeed + 2 * uint32_t(levels.size()) + pass, films_[pass]))
                return 0;
        levels.push_back({next, target_error(films_[0], films_[1], target_.metric)});
    }
    const int samples = std::max(samples_for_error(levels, chosen_.noise_target, target_.metric),
                                 chosen_.fewest_samples);
    estimated_ = error_of_samples(levels, samples, target_.metric);
    return samples;
}

void TargetedFrames::took(int samples, double ms) {
    if (target_.ms > 0) pace_.took(samples, ms);
    done_.push_back({samples, ms, estimated_});
}

std::string TargetedFrames::end_text() const {
    if (done_.empty()) return "";
    auto [few, many] = std::ranges::minmax(done_, {}, &Done::samples);
    std::string samples = fmt::format("{} to {} samples", few.samples, many.samples);
    if (target_.ms > 0) {
        const size_t first = done_.size() > kFramesToSettle ? kFramesToSettle : 0;
        double sum = 0;
        for (size_t i = first; i < done_.size(); ++i) sum += done_[i].ms;
        const double mean = sum / double(done_.size() - first);
        return fmt::format("{}: {} frames{} took {:.4g} ms in the mean, {:+.1f} %; {}",
                           target_text(target_), done_.size() - first,
                           first ? " after the first 8" : "", mean, 100 * (mean / target_.ms - 1),
                           samples);
    }
    auto [least, most] = std::ranges::minmax(done_, {}, &Done::error);
    return fmt::format("{}: {} frames with {}; their noise is estimated as {:.2g} to {:.2g}",
                       target_text(target_), done_.size(), samples, least.error, most.error);
}

}  // namespace kinora
