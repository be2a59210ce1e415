// runtime/programs/render/stats.h: what --stats tells of a run.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/programs/render/options.h"
#include "runtime/programs/render/run_report.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// Times in ms from the start of the program's work.
struct RunRecord {
    double load_ms = 0, build_ms = 0, first_ray_ms = 0;
    DiceStats dice;
    uint64_t texture_bytes = 0;  // of pictures that were decoded
};

// To stdout, as text or JSON. Of `frames`, the records are the first.
void print_stats(const RenderOptions& options, const RunRecord& run, const FrameTimes& frames,
                 const std::vector<FrameRecord>& records);

}  // namespace kinora
