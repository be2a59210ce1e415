// runtime/programs/common/progress.h: how far a render is, on a terminal or in a log.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/base/stats.h"

namespace kinora {

enum class ProgressStyle : uint8_t { None, Bar, Lines };

// Writes to stderr. Times left are told from the frames done so far.
class ProgressReport {
  public:
    ProgressReport(ProgressStyle style, size_t frames) : style_(style), frames_(frames) {}
    void tile(int64_t frame, size_t index, int done, int total);
    void frame_done(int64_t frame, size_t index, const std::string& file, double ms);
    void frame_skipped(int64_t frame, size_t index, const std::string& file);
    // Takes the bar away before something else is printed.
    void clear();

  private:
    void bar(int64_t frame, double done);
    ProgressStyle style_;
    size_t frames_;
    size_t skipped_ = 0;
    Stopwatch watch_;
    Stopwatch last_shown_;
    bool shown_ = false;
};

}  // namespace kinora
