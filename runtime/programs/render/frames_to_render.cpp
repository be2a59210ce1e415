// runtime/programs/render/frames_to_render.cpp: frames by number, by time, or all that the scene
// plays.
#include "runtime/programs/render/frames_to_render.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/resources.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

// COLLADA 1.5, <sampler pre_behavior post_behavior>.
bool moves_beyond_keys(const anim::Animation& animation) {
    return std::ranges::any_of(animation.samplers, [](const anim::Sampler& sampler) {
        return sampler.pre != anim::Behaviour::Constant ||
               sampler.post != anim::Behaviour::Constant;
    });
}

bool reads_time(const ShaderInstance& look) {
    using Source = FrameInput::Source;
    auto reads = [](const SceneKernel& kernel) {
        return std::ranges::any_of(kernel.inputs, [](const FrameInput& input) {
            return input.source == Source::Time || input.source == Source::Shutter;
        });
    };
    return reads(look.full) || (look.opacity && reads(*look.opacity));
}

// A file may have a range, and nothing in it that moves.
bool has_one_picture(const SceneDescription& description, const SceneShaders& shaders) {
    auto reads = [](const auto& look) { return reads_time(*look); };
    return description.animation.channels.empty() &&
           std::ranges::none_of(shaders.shader_instances, reads) &&
           std::ranges::none_of(shaders.vertex_instances, reads);
}

bool names_one_file(const RenderOptions& options) {
    return !options.output.empty() && !OutputName(options.output).has_token();
}

}  // namespace

std::optional<FrameTimes> frames_to_render(const RenderOptions& options, FrameRate rate,
                                           const SceneResources& scene,
                                           const SceneShaders& shaders) {
    const double start = scene.options.start_time, end = scene.options.end_time;
    FrameTimes list;
    if (const auto& own = scene.description->file_picture) {
        list.emplace_back(own->number, start);
    } else if (options.time) {
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
        double last = names_one_file(options) && has_one_picture(*scene.description, shaders)
                          ? first
                          : std::round(end * rate.value());
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
    if (list.size() > 1 && names_one_file(options)) {
        std::fprintf(stderr,
                     "kinora-render: %zu frames need a frame token in -o, like %s; or choose one "
                     "with --frames\n",
                     list.size(), "f.####.png");
        return std::nullopt;
    }
    return list;
}

FrameTimes middle_of_shot(const RenderOptions& options, FrameRate rate, double start, double end) {
    int64_t first = first_frame(rate, start), count = 0;
    if (options.turntable) {
        count = *options.turntable;
    } else {
        const double last = std::round(end * rate.value());
        if (!(std::abs(last) < kFurthestFrame) || int64_t(last) < first) return {};
        count = int64_t(last) - first + 1;
    }
    const int64_t middle = first + count / 2, before = std::max(first, middle - 1);
    return {{before, rate.time(before)}, {middle, rate.time(middle)}};
}

void report_past(const RenderOptions& options, FrameRate rate, const SceneResources& scene,
                 const FrameTimes& frames, Diagnostics& diagnostics) {
    const SceneOptions& played = scene.options;
    const bool chosen = options.frames || options.time;
    const bool moves = played.start_time < played.end_time;
    if (!chosen || !moves || moves_beyond_keys(scene.description->animation)) return;
    const double first = std::round(played.start_time * rate.value());
    const double last = std::round(played.end_time * rate.value());
    std::vector<int64_t> past;
    for (const auto& [frame, time] : frames)
        if (double(frame) > last) past.push_back(frame);
    if (!past.empty())
        diagnostics.report(Code::FRAMES_PAST, Location{}, frame_ranges(std::move(past)), first,
                           last);
}

}  // namespace kinora
