// runtime/play/pacer.cpp: fewer pixels at once where frames are late, more after a calm while.
//
// One late frame changes nothing: the median of three decides. Where a larger picture turned out
// too slow, the next one is tried only after twice as many calm frames, so sizes do not swing.
#include "runtime/play/pacer.h"

#include <algorithm>
#include <cmath>

namespace kinora {

double Pacer::scale_of(size_t step) {
    return std::exp2(-0.25 * double(step));
}

double Pacer::scale() const {
    return scale_of(step_);
}

void Pacer::forget() {
    known_ = 0;
    calm_ = 0;
    patience_ = since_larger_ = kFirstPatience;
}

double Pacer::median() const {
    std::array<double, 3> sorted = recent_;
    if (known_ < 3) return *std::min_element(sorted.begin(), sorted.begin() + ptrdiff_t(known_));
    std::sort(sorted.begin(), sorted.end());
    return sorted[1];
}

// The largest picture that takes no longer than the target.
size_t Pacer::fitting(double ms_of_all_pixels) const {
    size_t step = 0;
    while (step + 1 < kSteps && ms_of_all_pixels * scale_of(step) * scale_of(step) > target_)
        ++step;
    return step;
}

void Pacer::add(double ms) {
    for (size_t k = recent_.size() - 1; k > 0; --k) recent_[k] = recent_[k - 1];
    recent_[0] = ms / (scale() * scale());
    known_ = std::min(known_ + 1, recent_.size());
    since_larger_ = std::min(since_larger_ + 1, kMostPatience);

    double now = median();
    size_t wanted = fitting(now);
    if (wanted > step_) {
        if (since_larger_ < patience_) patience_ = std::min(2 * patience_, kMostPatience);
        step_ = wanted;
        calm_ = 0;
        return;
    }
    if (step_ == 0) return;
    double larger = scale_of(step_ - 1);
    bool fits = now * larger * larger <= kRoom * target_;
    calm_ = fits ? calm_ + 1 : 0;
    if (calm_ < patience_) return;
    --step_;
    calm_ = 0;
    since_larger_ = 0;
}

}  // namespace kinora
