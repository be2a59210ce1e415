// runtime/programs/render/stats.h: what --stats tells of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/frame/frame.h"
#include "runtime/programs/render/options.h"

namespace kinora {

struct FrameRecord {
    int64_t frame;
    size_t index = 0;  // among the frames of the run
    std::string file;
    FrameStats stats;
    size_t pixels = 0;
    int samples = 0;  // per pixel
    double write_ms = 0;
    double dice_error = 0;  // with the scene as loaded
    double redice_ms = 0;   // 0: that one was fine enough
    bool skipped = false;
};

// Times in ms from the start of the program's work.
struct RunRecord {
    double load_ms = 0, build_ms = 0, first_ray_ms = 0;
    DiceStats dice;
    uint64_t texture_bytes = 0;  // of pictures that were decoded
};

// To stdout, as text or JSON.
void print_stats(const RenderOptions& options, const RunRecord& run,
                 const std::vector<FrameRecord>& frames);

}  // namespace kinora
