// runtime/base/stage_clock.cpp: the CPU's counter, and each thread's clock.
#include "runtime/base/stage_clock.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

namespace kinora {

namespace {

constinit thread_local StageClock* t_clock = nullptr;

constexpr const char* kNames[] = {"other",   "animate", "skin",   "refit",  "sample",
                                  "trace",   "points",  "gather", "lights", "shadows",
                                  "kernels", "nested",  "film",   "imager", "idle"};
static_assert(std::size(kNames) == kStageCount);

}  // namespace

const char* stage_name(Stage stage) {
    return kNames[size_t(stage)];
}

uint64_t StageTicks::sum() const {
    return std::accumulate(of.begin(), of.end(), uint64_t{0});
}

void StageTicks::operator+=(const StageTicks& o) {
    for (size_t s = 0; s < kStageCount; ++s) of[s] += o.of[s];
}

uint64_t cpu_ticks() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
    uint64_t ticks;
    asm volatile("mrs %0, cntvct_el0" : "=r"(ticks));
    return ticks;
#else
    return uint64_t(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

// A counter that steps back, between two cores, counts as one that stands still.
Stage StageClock::enter(Stage stage) {
    const uint64_t now = std::max(now_(), since_);
    ticks_[stage_] += now - since_;
    since_ = now;
    return std::exchange(stage_, stage);
}

StageTicks StageClock::ticks() {
    enter(stage_);
    return ticks_;
}

RunningClock::RunningClock(StageClock& clock) : before_(std::exchange(t_clock, &clock)) {}
RunningClock::~RunningClock() {
    t_clock = before_;
}

StageScope::StageScope(Stage stage) : clock_(t_clock) {
    if (clock_) before_ = clock_->enter(stage);
}
StageScope::~StageScope() {
    if (clock_) clock_->enter(before_);
}

std::array<double, kStageCount> stage_ms(const StageTicks& frame, const StageTicks& tiles,
                                         int threads, double total_ms) {
    std::array<double, kStageCount> ms{};
    const uint64_t all = frame.sum();
    if (all == 0) {
        ms[size_t(Stage::Other)] = total_ms;
        return ms;
    }
    // Counters of two cores may differ by a little: the threads' sum is never more than they had.
    const double shared = double(frame[Stage::Idle]), busy = double(tiles.sum()) / threads;
    const double fit = busy > shared ? shared / busy : 1;
    for (size_t s = 0; s < kStageCount; ++s)
        ms[s] = double(frame.of[s]) + double(tiles.of[s]) / threads * fit;
    ms[size_t(Stage::Idle)] -= busy * fit;
    for (double& m : ms) m *= total_ms / double(all);
    return ms;
}

}  // namespace kinora
