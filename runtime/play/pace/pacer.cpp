// runtime/play/pace/pacer.cpp: fewer pixels at once where frames are late, more after a calm while.
//
// One late frame changes nothing: the median of three decides, and that of fifteen where the time
// is nearly met. Between the size that is too slow and the one that has room lies more than a step,
// so jitter has no pair of sizes to swing between. Where a larger picture turned out too slow, the
// next one is tried only after twice as many calm frames.
#include "runtime/play/pace/pacer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinora {

double Pacer::scale_of(size_t step) {
    return std::exp2(-0.125 * double(step));
}

double Pacer::scale() const {
    return scale_of(step_);
}

void Pacer::forget() {
    known_ = 0;
    calm_ = 0;
    patience_ = since_larger_ = kFirstPatience;
}

void Pacer::begin() {
    forget();
    step_ = kSteps - 1;
    first_ = true;
}

// The median of what the last frames would have taken at that size; of fewer than three the least.
double Pacer::time_at(size_t step, size_t frames) const {
    const size_t count = std::min(frames, known_);
    const double pixels = scale_of(step) * scale_of(step);
    std::array<double, kWindow> times{};
    for (size_t k = 0; k < count; ++k) times[k] = recent_[k].fixed + recent_[k].whole * pixels;
    std::sort(times.begin(), times.begin() + ptrdiff_t(count));
    return times[count < kFew ? 0 : count / 2];
}

// The largest picture that takes no longer.
size_t Pacer::fitting(double ms, size_t frames) const {
    size_t step = 0;
    while (step + 1 < kSteps && time_at(step, frames) > ms) ++step;
    return step;
}

void Pacer::shrink(size_t step) {
    if (since_larger_ < patience_) patience_ = std::min(2 * patience_, kMostPatience);
    step_ = step;
    calm_ = 0;
}

void Pacer::add(double ms, double fixed_ms) {
    if (std::exchange(first_, false)) {  // with what is done once, it says little of the others
        if (ms <= target_) step_ = 0;
        return;
    }
    std::rotate(recent_.begin(), recent_.end() - 1, recent_.end());
    const double fixed = std::clamp(fixed_ms, 0.0, ms);
    recent_[0] = {(ms - fixed) / (scale() * scale()), fixed};
    known_ = std::min(known_ + 1, kWindow);
    since_larger_ = std::min(since_larger_ + 1, kMostPatience);

    if (time_at(step_, kFew) > kMuch * target_ && step_ + 1 < kSteps) {
        known_ = std::min(known_, kFew);  // what was before says nothing
        return shrink(fitting(target_, kFew));
    }
    if (known_ < kWindow) return;
    if (const size_t wanted = fitting(target_, kWindow); wanted > step_) return shrink(wanted);
    const bool fits = step_ > 0 && time_at(step_ - 1, kWindow) <= kRoom * target_;
    calm_ = fits ? calm_ + 1 : 0;
    if (calm_ < patience_) return;
    step_ = std::min(step_ - 1, fitting(kRoom * target_, kWindow));
    calm_ = 0;
    since_larger_ = 0;
}

}  // namespace kinora
