// runtime/base/stats.h: clocks and memory, for reports.
#pragma once

#include <chrono>
#include <cstddef>

namespace kinora {

// Wall time since construction or the last restart, on a monotonic clock.
class Stopwatch {
  public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }
    double restart() {
        double elapsed = ms();
        start_ = Clock::now();
        return elapsed;
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

// Adds the life of the object to `total_ms`.
class StageTimer {
  public:
    explicit StageTimer(double& total_ms) : total_(total_ms) {}
    ~StageTimer() { total_ += watch_.ms(); }
    StageTimer(const StageTimer&) = delete;

  private:
    double& total_;
    Stopwatch watch_;
};

size_t peak_memory_bytes();  // largest resident size of this process so far

}  // namespace kinora
