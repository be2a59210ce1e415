// runtime/programs/render/frames_to_render.cpp: frames by number, by time, or all that the scene
// plays.
#include "runtime/programs/render/frames_to_render.h"

#include <cmath>
#include <cstdio>

#include "runtime/programs/open/open_scene.h"

namespace kinora {

std::optional<std::vector<std::pair<int64_t, double>>> frames_to_render(
    const RenderOptions& options, FrameRate rate, double start, double end) {
    std::vector<std::pair<int64_t, double>> list;
    if (options.time) {
        list.emplace_back(std::llround(*options.time * rate.value()), *options.time);
    } else if (options.frames) {
        for (int64_t frame : *options.frames) list.emplace_back(frame, rate.time(frame));
    } else if (options.session) {
        double frame = options.session->frame;
        list.emplace_back(std::llround(frame), seconds_of(rate, frame));
    } else if (options.turntable) {
        int64_t first = first_frame(rate, start);
        for (int64_t frame = first; frame < first + *options.turntable; ++frame)
            list.emplace_back(frame, rate.time(frame));
    } else {
        double first = std::round(start * rate.value());
        double last = std::round(end * rate.value());
        bool sound = std::abs(first) < kFurthestFrame && std::abs(last) < kFurthestFrame;
        if (!sound || last - first >= kMostFrames) {
            std::fprintf(stderr,
                         "kinora-render: the scene plays from %g to %g seconds, more than %lld "
                         "frames; choose with --frames or --time\n",
                         start, end, static_cast<long long>(kMostFrames));
            return std::nullopt;
        }
        for (int64_t frame = int64_t(first); frame <= int64_t(last); ++frame)
            list.emplace_back(frame, rate.time(frame));
    }
    if (list.size() > 1 && !options.output.empty() && !OutputName(options.output).has_token()) {
        std::fprintf(stderr,
                     "kinora-render: %zu frames need a frame token in -o, like %s; or choose one "
                     "with --frames\n",
                     list.size(), "f.####.png");
        return std::nullopt;
    }
    return list;
}

}  // namespace kinora
