// runtime/kinora/frame_list.h: which frames, at what times, to which files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

inline constexpr int64_t kMostFrames = 10'000'000;  // of one run

// "1-240x2,300,10-1x-1", also "1..240", "1:240x2", "1-240:2"; negative numbers allowed ("-5--1").
// A frame that several ranges name is there once, at its first place. Nothing, with a text in
// `error`, when it is malformed or names no frame.
std::optional<std::vector<int64_t>> parse_frames(std::string_view text, std::string& error);
// "7, 31-34" of frames in any order.
std::string frame_ranges(std::vector<int64_t> frames);

// Frames per second as a fraction: "24", "23.976", "24000/1001", "29.97" (the NTSC decimals mean
// their exact fractions).
struct FrameRate {
    int64_t numerator = 24, denominator = 1;
    double value() const { return double(numerator) / double(denominator); }
    // Frame n is at n / fps, computed from whole numbers: never an accumulated sum.
    double time(int64_t frame) const { return double(frame * denominator) / double(numerator); }
};
std::optional<FrameRate> parse_frame_rate(std::string_view text);
FrameRate frame_rate_of(double value);

// A file name with its frame token, "####" or "%04d"; `has_token` tells whether it has one.
struct OutputName {
    explicit OutputName(std::string pattern);
    std::string file(int64_t frame) const;
    std::string number(int64_t frame) const;  // that the token becomes; "" without one
    bool has_token() const { return digits_ > 0; }

  private:
    std::string before_, after_;
    int digits_ = 0;
};

}  // namespace kinora
