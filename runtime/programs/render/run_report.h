// runtime/programs/render/run_report.h: what became of the frames of a run.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/picture/frame/frame.h"

namespace kinora {

// Aborted: not begun or not finished when the run ended.
enum class FrameState : uint8_t { Aborted, Done, Kept, Failed };
const char* frame_state_name(FrameState state);

struct FrameRecord {
    int64_t frame;
    size_t index = 0;  // among the frames of the run
    std::string file;
    FrameState state = FrameState::Aborted;
    FrameStats stats;
    size_t pixels = 0;
    int samples = 0;  // per pixel
    double write_ms = 0;
    double dice_error = 0;  // with the scene as loaded
    double redice_ms = 0;   // 0: that one was fine enough
};

// Numbers and times, seconds, of all frames that a run is to make.
using FrameTimes = std::vector<std::pair<int64_t, double>>;

// "46 of 48 frames; failed: 7, 31; aborted: 40-48". Records are those of the first frames; what
// follows them was not begun.
std::string frames_text(const FrameTimes& frames, const std::vector<FrameRecord>& records);
bool all_frames_there(const FrameTimes& frames, const std::vector<FrameRecord>& records);

// Marks frames whose pictures are not there any more as failed, and returns their files: someone
// has removed them, or their folder.
std::vector<std::string> mark_lost_frames(std::vector<FrameRecord>& records);
bool folder_is_there(const std::string& file);

}  // namespace kinora
