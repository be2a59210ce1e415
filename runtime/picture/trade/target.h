// runtime/picture/trade/target.h: what a frame may take, or how far it may be off, and the samples
// for it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kinora {

enum class TargetMetric : uint8_t { Flip, Rmse };

// Of kinora-render's --target-ms and --target-error; 0: not asked for.
struct FrameTarget {
    double ms = 0;     // wall time of a frame without writing it, on the threads given
    double error = 0;  // against the picture at `reference`
    TargetMetric metric = TargetMetric::Flip;

    bool any() const { return ms > 0 || error > 0; }
};
const char* target_metric_name(TargetMetric metric);  // "flip": as tradeoff.json has it
// "--target-error flip:0.01"; "" of none.
std::string target_text(const FrameTarget& target);
// "0.01", "flip:0.01" or "rmse:0.01". Nothing: it is none of these, or not above 0 and below 1.
std::optional<FrameTarget> parse_target_error(std::string_view text);

// What frames take: milliseconds besides samples, and of each sample of all pixels.
struct FrameCost {
    double fixed_ms = 0, sample_ms = 0;
    double at(int samples) const { return fixed_ms + samples * sample_ms; }
};
// The line through two frames; neither part is negative.
FrameCost fit_cost(int few, double few_ms, int more, double more_ms);

// The samples of each frame, so that the frames take `ms` in the mean. What a frame took corrects
// the cost of the next, and what all took so far is paid back by those to come. Whole samples that
// are too coarse for the time are mixed: 1, 2, 1, 1, 2.
class FramePace {
  public:
    FramePace(double ms, const FrameCost& cost) : ms_(ms), cost_(cost) {}
    int samples() const;  // of the next frame
    void took(int samples, double ms);

  private:
    double ms_;
    FrameCost cost_;
    double debt_ms_ = 0;  // taken too much by the frames of late
};

// How far two pictures with so many samples and different seeds are apart.
struct NoiseLevel {
    int samples = 0;
    double difference = 0;
};
// The error of one such picture against the one without noise. Of RMSE: the difference has twice
// the variance. FLIP grows with its color differences to the power of 0.7 at least.
double noise_error(const NoiseLevel& level, TargetMetric metric);

inline constexpr double kErrorMargin = 1.5;  // of estimated errors
// The samples at which kErrorMargin times the noise is no larger than `error`. The errors of the
// last two levels say how it falls with samples, at most with their root.
int samples_for_error(std::span<const NoiseLevel> levels, double error, TargetMetric metric);

// The error of a picture with so many samples, by the same law; without the margin.
double error_of_samples(std::span<const NoiseLevel> levels, int samples, TargetMetric metric);

inline constexpr int kFewestSamples = 4;  // with fewer, edges hide in the noise
// The samples of the next pair of pictures that estimates the noise; 0: the last pair has a
// sixth of the samples that it asks for, or more. From an eighth, walker.dae missed its error.
int next_noise_level(std::span<const NoiseLevel> levels, double error, TargetMetric metric);

}  // namespace kinora
