// runtime/picture/trade/target.cpp: the line of costs, the pace of frames, the fall of noise.
#include "runtime/picture/trade/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace kinora {

namespace {

constexpr double kMostSamples = 1 << 20;  // as --spp
constexpr double kKept = 0.9;             // of the debt, from frame to frame
constexpr double kPaidBack = 0.3;         // of the debt, by the next frame
constexpr int kSecondLevel = 4 * kFewestSamples;
// Of errors with samples. Few well-spread samples fall faster than the many that follow.
constexpr double kSlowestFall = 0.25, kUsualFall = 0.5, kFastestFall = 1;
constexpr int kFurthest = 6;        // times the samples of the last level: an estimate still holds
constexpr int kLevelsPerFrame = 5;  // a level has a fifth of a frame's samples
constexpr int kLongestStep = 16;    // from one level to the next
constexpr const char* kMetricNames[] = {"flip", "rmse"};

int whole_samples(double samples, double least) {
    return int(std::clamp(std::ceil(samples - 1e-9), least, kMostSamples));
}

// The exponent s of error ~ samples^-s.
double fall_of(std::span<const NoiseLevel> levels) {
    if (levels.size() < 2) return kUsualFall;
    const NoiseLevel &a = levels[levels.size() - 2], &b = levels.back();
    if (!(a.difference > 0 && b.difference > 0)) return kUsualFall;
    double fall = std::log(a.difference / b.difference) / std::log(double(b.samples) / a.samples);
    return std::clamp(fall, kSlowestFall, kFastestFall);
}

// The fall from the last level to more samples, which is not trusted beyond the usual, or to fewer.
double fall_from(std::span<const NoiseLevel> levels, bool to_more) {
    const double fall = fall_of(levels);
    return to_more ? std::min(fall, kUsualFall) : fall;
}

}  // namespace

const char* target_metric_name(TargetMetric metric) {
    return kMetricNames[size_t(metric)];
}

std::string target_text(const FrameTarget& target) {
    if (target.ms > 0) return fmt::format("--target-ms {:g}", target.ms);
    if (!target.any()) return "";
    return fmt::format("--target-error {}:{:g}", target_metric_name(target.metric), target.error);
}

std::optional<FrameTarget> parse_target_error(std::string_view text) {
    FrameTarget target;
    if (size_t colon = text.find(':'); colon != std::string_view::npos) {
        auto name = std::ranges::find(kMetricNames, text.substr(0, colon));
        if (name == std::end(kMetricNames)) return std::nullopt;
        target.metric = TargetMetric(name - std::begin(kMetricNames));
        text.remove_prefix(colon + 1);
    }
    const char* last = text.data() + text.size();
    auto [end, code] = std::from_chars(text.data(), last, target.error);
    if (code != std::errc() || end != last || !(target.error > 0 && target.error < 1))
        return std::nullopt;
    return target;
}

FrameCost fit_cost(int few, double few_ms, int more, double more_ms) {
    FrameCost cost;
    cost.sample_ms = std::max((more_ms - few_ms) / (more - few), 0.0);
    cost.fixed_ms = std::max(few_ms - few * cost.sample_ms, 0.0);
    // A clock that says less of more samples: all of the time is taken to be theirs.
    if (cost.sample_ms == 0) return {0, more_ms / more};
    return cost;
}

int FramePace::samples() const {
    const double aim = std::clamp(ms_ - kPaidBack * debt_ms_, 0.5 * ms_, 1.5 * ms_);
    const double samples = (aim - cost_.fixed_ms) / std::max(cost_.sample_ms, 1e-9);
    return int(std::clamp(std::round(samples), 1.0, kMostSamples));
}

void FramePace::took(int samples, double ms) {
    // Half of what the cost was wrong by, as a ratio: other programs take their part of the time.
    const double wrong = std::sqrt(std::clamp(ms / std::max(cost_.at(samples), 1e-9), 0.25, 4.0));
    cost_.fixed_ms *= wrong;
    cost_.sample_ms *= wrong;
    debt_ms_ = kKept * debt_ms_ + ms - ms_;
}

double noise_error(const NoiseLevel& level, TargetMetric metric) {
    const double power = metric == TargetMetric::Rmse ? 1 : 0.7;
    return level.difference / std::pow(2, 0.5 * power);
}

int samples_for_error(std::span<const NoiseLevel> levels, double error, TargetMetric metric) {
    if (levels.empty()) return kFewestSamples;
    const double wrong = kErrorMargin * noise_error(levels.back(), metric) / error;
    if (wrong <= 1 && levels.size() == 1) return levels.back().samples;
    return whole_samples(levels.back().samples * std::pow(wrong, 1 / fall_from(levels, wrong > 1)),
                         kFewestSamples);
}

double error_of_samples(std::span<const NoiseLevel> levels, int samples, TargetMetric metric) {
    if (levels.empty()) return 0;
    const NoiseLevel& last = levels.back();
    return noise_error(last, metric) *
           std::pow(double(last.samples) / samples, fall_from(levels, samples > last.samples));
}

int next_noise_level(std::span<const NoiseLevel> levels, double error, TargetMetric metric) {
    if (levels.empty()) return kFewestSamples;
    const int wanted = samples_for_error(levels, error, metric), last = levels.back().samples;
    if (wanted <= last) return 0;
    if (levels.size() == 1) return kSecondLevel;
    if (wanted <= kFurthest * last) return 0;
    return std::min(wanted / kLevelsPerFrame, kLongestStep * last);
}

}  // namespace kinora
