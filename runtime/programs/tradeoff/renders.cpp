// runtime/programs/tradeoff/renders.cpp: builds, poses, renders and reads the CPU's clock.
#include "runtime/programs/tradeoff/renders.h"

#include "runtime/base/cpu_clock.h"
#include "runtime/base/stats.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

WorkCounts work_of(const FrameStats& s) {
    return {s.camera_rays.rays,           s.camera_rays.shadow_rays, s.shader_rays.rays,
            s.shader_rays.shadow_rays,    s.camera_rays.packets,     s.shader_rays.packets,
            s.shader_rays.shadow_packets, s.shading_points,          s.light_points,
            uint64_t(s.refits),           uint64_t(s.rebuilds)};
}

}  // namespace

PosedScene TradeRenders::build(const Quality& quality) {
    ImportedScene imported = request_.imported;
    imported.options.quality = quality;
    const size_t known = diagnostics_.findings().size();
    BuiltScene built = build_imported(std::move(imported), diagnostics_);
    diagnostics_.drop_repeats(known);
    return {std::move(built.scene), std::move(built.pose)};
}

FrameSettings TradeRenders::settings_of(PosedScene& scene) {
    return frame_settings(request_.scene, *scene.scene, *scene.pose, diagnostics_, request_.stop);
}

void TradeRenders::set_size(int width, int height) {
    settings_.width = width;
    settings_.height = height;
}

bool TradeRenders::pose(PosedScene& scene, double time) {
    FrameStats stats;
    const size_t known = diagnostics_.findings().size();
    bool posed = pose_frame(*scene.scene, *scene.pose, time, settings_, stats, diagnostics_);
    diagnostics_.drop_repeats(known);
    return posed;
}

bool TradeRenders::render(PosedScene& scene, const Quality& quality, const TradeFrame& frame,
                          uint32_t seed, raytrace::Film& film, FrameStats& stats) {
    FrameSettings settings = settings_;
    set_sampling(settings.integrator, quality);
    SceneRequest seeded;
    seeded.seed = request_.scene.seed + seed;
    settings.integrator.seed = frame_seed(seeded, frame.number);
    const size_t known = diagnostics_.findings().size();
    bool whole =
        render_frame(*scene.scene, *scene.pose, frame.time, settings, film, stats, diagnostics_);
    diagnostics_.drop_repeats(known);
    return whole;
}

TimedFrame TradeRenders::frame(PosedScene& scene, const Quality& quality, const TradeFrame& frame,
                               uint32_t seed, raytrace::Film& film) {
    TimedFrame timed;
    if (!pose(scene, frame.before)) return timed;
    FrameStats stats;
    const double cpu = process_cpu_ms();
    Stopwatch wall;
    timed.whole = render(scene, quality, frame, seed, film, stats);
    timed.wall_ms = wall.ms();
    timed.cpu_ms = process_cpu_ms() - cpu;
    timed.work = work_of(stats);
    double busy = 0;  // threads that wait take no CPU time
    for (size_t s = 0; s < kStageCount; ++s)
        if (Stage(s) != Stage::Idle) busy += stats.stages[s];
    for (size_t s = 0; s < kStageCount; ++s)
        if (Stage(s) != Stage::Idle && busy > 0)
            timed.stages[s] = timed.cpu_ms * stats.stages[s] / busy;
    return timed;
}

bool TradeRenders::centres(PosedScene& scene, const Quality& quality, const TradeFrame& frame,
                           raytrace::Film& film) {
    Quality one = quality;
    one.samples_per_pixel = 1;
    FrameStats stats;
    return render(scene, one, frame, 0, film, stats);
}

}  // namespace kinora
