// runtime/programs/common/progress.cpp: a bar that is drawn over itself, or one line a frame.
#include "runtime/programs/common/progress.h"

#include <fmt/format.h>

#include <cstdio>

namespace kinora {

namespace {
constexpr double kRedrawMs = 100;
constexpr int kBarWidth = 32;
}  // namespace

void ProgressReport::bar(int64_t frame, double done) {
    double part = done / double(frames_);
    double rendered = done - double(skipped_);  // frames kept took no time
    std::string left;
    if (part > 0.01 && rendered > 0) {
        int seconds = int(watch_.ms() / rendered * (double(frames_) - done) / 1000);
        left = fmt::format(", {}:{:02} left", seconds / 60, seconds % 60);
    }
    int filled = int(part * kBarWidth);
    std::fprintf(stderr, "\r\x1b[K[%s%s] %3d%% frame %lld%s",
                 std::string(size_t(filled), '=').c_str(),
                 std::string(size_t(kBarWidth - filled), ' ').c_str(), int(part * 100),
                 static_cast<long long>(frame), left.c_str());
    shown_ = true;
}

void ProgressReport::tile(int64_t frame, size_t index, int done, int total) {
    if (style_ != ProgressStyle::Bar || (shown_ && last_shown_.ms() < kRedrawMs)) return;
    last_shown_.restart();
    bar(frame, double(index) + double(done) / double(total));
}

void ProgressReport::frame_done(int64_t frame, size_t index, const std::string& file, double ms) {
    if (style_ == ProgressStyle::Lines)
        std::fprintf(stderr, "frame %lld (%zu/%zu) %.1f ms %s\n", static_cast<long long>(frame),
                     index + 1, frames_, ms, file.c_str());
    if (style_ == ProgressStyle::Bar) bar(frame, double(index + 1));
}

void ProgressReport::frame_skipped(int64_t frame, size_t index, const std::string& file) {
    ++skipped_;
    if (style_ == ProgressStyle::Lines)
        std::fprintf(stderr, "frame %lld (%zu/%zu) kept %s\n", static_cast<long long>(frame),
                     index + 1, frames_, file.c_str());
}

void ProgressReport::clear() {
    if (shown_) std::fprintf(stderr, "\r\x1b[K");
    shown_ = false;
}

}  // namespace kinora
