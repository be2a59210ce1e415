// runtime/programs/tradeoff/frames.cpp: first, middle, last and fastest.
#include "runtime/programs/tradeoff/frames.h"

#include <algorithm>

#include "runtime/base/stats.h"
#include "runtime/programs/tradeoff/probes.h"

namespace kinora {

namespace {

constexpr size_t kMostPoses = 32;
constexpr size_t kMostVertices = 512;  // of a shape

using FrameTimes = std::vector<std::pair<int64_t, double>>;

TradeFrame trade_frame(const FrameTimes& frames, size_t i, const char* why) {
    return {frames[i].first, frames[i].second, frames[i > 0 ? i - 1 : i].second, why};
}

// How far a vertex goes from the frame before to this one.
double step_into(const FrameTimes& frames, size_t i, TradeRenders& renders, PosedScene& scene) {
    if (!renders.pose(scene, frames[i - 1].second)) return 0;
    auto stand = [&] { return vertex_positions(*scene.scene, *scene.pose, kMostVertices); };
    const auto before = stand();
    if (!renders.pose(scene, frames[i].second)) return 0;
    return largest_step(before, stand()).value_or(0);
}

}  // namespace

ChosenFrames choose_trade_frames(const FrameTimes& frames, TradeRenders& renders, PosedScene& scene,
                                 double most_ms) {
    ChosenFrames chosen;
    Stopwatch watch;
    size_t fastest = 0;
    const size_t step = std::max<size_t>(1, (frames.size() + kMostPoses - 1) / kMostPoses);
    for (size_t i = 1; i < frames.size() && watch.ms() < most_ms; i += step) {
        double moved = step_into(frames, i, renders, scene);
        if (moved <= chosen.fastest_step) continue;
        chosen.fastest_step = moved;
        fastest = i;
    }
    auto add = [&](size_t i, const char* why) {
        for (TradeFrame& known : chosen.frames)
            if (known.number == frames[i].first) {
                known.why += std::string(", ") + why;
                return;
            }
        chosen.frames.push_back(trade_frame(frames, i, why));
    };
    if (chosen.fastest_step > 0) add(fastest, "fastest");
    add(frames.size() - 1, "last");
    // Where nothing moves all frames are the same picture.
    if (chosen.fastest_step == 0) return chosen;
    add(0, "first");
    add(frames.size() / 2, "middle");
    return chosen;
}

}  // namespace kinora
