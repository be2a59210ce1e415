// runtime/programs/tradeoff/frames.h: which frames of a shot a trade-off renders.
#pragma once

#include "runtime/programs/tradeoff/renders.h"

namespace kinora {

struct ChosenFrames {
    std::vector<TradeFrame> frames;  // the fastest first; each once
    double fastest_step = 0;         // of a vertex, units
};

// The frame into which vertices move most, then the last, the first and the middle one. Poses the
// scene at up to some ten frames, evenly chosen, for at most `most_ms`.
ChosenFrames choose_trade_frames(const std::vector<std::pair<int64_t, double>>& frames,
                                 TradeRenders& renders, PosedScene& scene, double most_ms);

}  // namespace kinora
