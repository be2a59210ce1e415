// runtime/programs/tradeoff/renders.h: scenes of the same file at other settings, and timed frames.
#pragma once

#include <map>

#include "runtime/programs/tradeoff/tradeoff.h"

namespace kinora {

// Rays, points and updates of the tree: what a frame did, whatever the machine does besides.
using WorkCounts = std::array<uint64_t, 11>;

struct TimedFrame {
    double cpu_ms = 0, wall_ms = 0;
    WorkCounts work{};
    std::array<double, kStageCount> stages{};  // CPU ms; they sum to cpu_ms
    bool whole = false;
};

class TradeRenders {
  public:
    TradeRenders(const TradeoffRequest& request, Diagnostics& diagnostics)
        : request_(request), diagnostics_(diagnostics) {}

    // Nothing: findings say why.
    PosedScene build(const Quality& quality);
    // The size in pixels that the request and the scene's camera come to, and the gain.
    FrameSettings settings_of(PosedScene& scene);
    void set_settings(const FrameSettings& settings) { settings_ = settings; }
    void set_size(int width, int height);

    // Poses the scene at the frame before, then times the frame. seed: 0 for variants, 1 and 2 for
    // references.
    TimedFrame frame(PosedScene& scene, const Quality& quality, const TradeFrame& frame,
                     uint32_t seed, raytrace::Film& film);
    // With one sample, at pixels' centres; no time is taken.
    bool centres(PosedScene& scene, const Quality& quality, const TradeFrame& frame,
                 raytrace::Film& film);
    bool pose(PosedScene& scene, double time);
    bool stopped() const { return request_.stop && *request_.stop != 0; }

  private:
    bool render(PosedScene& scene, const Quality& quality, const TradeFrame& frame, uint32_t seed,
                raytrace::Film& film, FrameStats& stats);

    const TradeoffRequest& request_;
    Diagnostics& diagnostics_;
    FrameSettings settings_;
};

}  // namespace kinora
