// runtime/player/pace/pacer.cpp: fewer pixels at once where frames are late, more after a few calm
// ones.
//
// One late frame changes nothing: the median of three decides, and that of fifteen where the time
// is nearly met. A picture becomes larger where each of the last frames says that there is room, so
// the slowest of them decides: jitter has no pair of sizes to swing between. Where a larger picture
// turned out too slow, the next one is tried only after twice as many calm frames.
#include "runtime/player/pace/pacer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kinora {

namespace {

constexpr double kSmallMay = 3;       // times the target: what the smallest pictures may take
constexpr double kIsCut = 4.5;        // no frame is waited for any longer
constexpr double kFirstMay = 4;       // times that: a scene's first frame fills buffers and caches
constexpr size_t kCutSteps = 16;      // a sixteenth of the pixels
constexpr double kMostInVain = 2000;  // ms

}  // namespace

double Pacer::scale_of(size_t step) {
    return std::exp2(-0.125 * double(step));
}

double Pacer::scale() const {
    return scale_of(step_);
}

void Pacer::begin() {
    known_ = 0;
    in_vain_ = 0;
    calm_ = 0;
    patience_ = kFirstPatience;
    since_larger_ = kMostPatience;
    step_ = kUsualSteps - 1;
    first_ = true;
}

// What a frame of that size would take, as a share of what it may. The smallest usual one and those
// behind it may take longer.
double Pacer::load(const Cost& cost, size_t step) const {
    const double scale = scale_of(step), pixels = cost.whole * scale * scale;
    const double guide = scale < kNeedsGuide ? cost.guide : 0;
    const double usual = (cost.fixed + guide + pixels) / target_;
    return step + 1 < kUsualSteps ? usual : std::min(usual, pixels / (kSmallMay * target_));
}

// The median of what the last frames say; of fewer than three the least.
double Pacer::load_at(size_t step, size_t frames) const {
    const size_t count = std::min(frames, known_);
    std::array<double, kWindow> loads{};
    for (size_t k = 0; k < count; ++k) loads[k] = load(recent_[k], step);
    std::sort(loads.begin(), loads.begin() + ptrdiff_t(count));
    return loads[count < kFew ? 0 : count / 2];
}

double Pacer::most_load(size_t step, size_t frames) const {
    double most = 0;
    for (size_t k = 0; k < std::min(frames, known_); ++k)
        most = std::max(most, load(recent_[k], step));
    return most;
}

void Pacer::remember(double ms, double fixed_ms, double guide_ms) {
    std::rotate(recent_.begin(), recent_.end() - 1, recent_.end());
    const double fixed = std::clamp(fixed_ms, 0.0, ms);
    const double guide = std::clamp(guide_ms, 0.0, ms - fixed);
    recent_[0] = {(ms - fixed - guide) / (scale() * scale()), fixed, guide};
    known_ = std::min(known_ + 1, kWindow);
    since_larger_ = std::min(since_larger_ + 1, kMostPatience);
}

void Pacer::become_smaller(size_t step) {
    if (since_larger_ < 2 * patience_) patience_ = std::min(2 * patience_, kMostPatience);
    since_larger_ = kMostPatience;
    step_ = step;
    calm_ = 0;
}

// To the largest size that fits, by so many frames. False: this one does.
bool Pacer::shrink(size_t frames) {
    size_t step = step_;
    while (step + 1 < kSteps && load_at(step, frames) > 1) ++step;
    if (step == step_) return false;
    known_ = std::min(known_, frames);  // what was before says nothing
    become_smaller(step);
    return true;
}

void Pacer::grow() {
    const size_t frames = size_t(std::min(patience_, int(kWindow)));
    size_t step = step_ - 1;
    while (step > 0 && most_load(step - 1, frames) <= kRoom) --step;
    step_ = step;
    known_ = std::min(known_, frames);  // those before were of another load
    calm_ = 0;
    since_larger_ = 0;
}

void Pacer::add(double ms, double fixed_ms, double guide_ms) {
    in_vain_ = 0;
    if (std::exchange(first_, false)) {  // with what is done once, it says little of the others
        if (ms <= target_) step_ = 0;
        return;
    }
    remember(ms, fixed_ms, guide_ms);
    if (load_at(step_, kFew) > kMuch && shrink(kFew)) return;
    if (known_ == kWindow && shrink(kWindow)) return;
    calm_ = step_ > 0 && load(recent_[0], step_ - 1) <= kRoom ? calm_ + 1 : 0;
    if (calm_ >= patience_) grow();
}

double Pacer::limit(bool time_goes_on) const {
    const bool is_smallest = step_ + 1 >= kSteps;
    if (is_smallest && (!time_goes_on || in_vain_ >= kMostInVain))
        return std::numeric_limits<double>::infinity();
    const double pixels = kIsCut * target_ * (first_ ? kFirstMay : 1);
    return pixels + (known_ > 0 ? recent_[0].fixed : 0);
}

void Pacer::cut(double ms, double fixed_ms) {
    first_ = false;
    known_ = 0;
    in_vain_ += ms;
    remember(ms, fixed_ms, 0);
    become_smaller(std::min(step_ + kCutSteps, kSteps - 1));
}

}  // namespace kinora
