// runtime/programs/render/frames_to_render.h: the frames that a command line asks for, and their
// times.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/programs/render/options.h"

namespace kinora {

// Frames and their times, seconds: --time, --frames, a turn of the turntable, or all from `start`
// to `end` seconds. Nothing, with a message on stderr, where they are too many or -o has one name
// for several.
std::optional<std::vector<std::pair<int64_t, double>>> frames_to_render(
    const RenderOptions& options, FrameRate rate, double start, double end);

}  // namespace kinora
