// runtime/player/pace/patience.cpp: twice the time after each picture that came to nothing.
#include "runtime/player/pace/patience.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

constexpr double kLate = 1.5;         // of a picture's time
constexpr size_t kMostDoublings = 7;  // 6.4 s at 30 pictures a second: it may never end

}  // namespace

double patience_ms(double rate, size_t ended) {
    return kLate * 1000 / std::max(rate, 1e-3) * std::exp2(double(std::min(ended, kMostDoublings)));
}

}  // namespace kinora
