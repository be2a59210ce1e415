// runtime/programs/render/stats.cpp: times and counts of a run, as text and as JSON.
#include "runtime/programs/render/stats.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "jit/compiler.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"

namespace kinora {

namespace {

const jit::Target& target_of(const RenderOptions& options) {
    return options.target ? *options.target : jit::best_target();
}

// Frames that meshes were diced again for, and the ms that took.
std::pair<size_t, double> rediced(const std::vector<FrameRecord>& frames) {
    std::pair<size_t, double> sum{0, 0.0};
    for (const FrameRecord& r : frames) {
        sum.first += r.redice_ms > 0;
        sum.second += r.redice_ms;
    }
    return sum;
}

// The stages of which a frame's time is the sum, with the writing after it: f(name, ms).
template <class F>
void for_each_stage(const FrameRecord& record, F&& f) {
    for (size_t s = 0; s < kStageCount; ++s) f(stage_name(Stage(s)), record.stats.stages[s]);
    f("write", record.write_ms);
}

// How full the packets of 16 are on the mean, 0 to 1.
double occupancy(uint64_t rays, uint64_t packets) {
    return packets ? double(rays) / double(raytrace::kPacket * packets) : 0;
}

struct Occupancy {
    double camera, shadow, nested;
};
Occupancy occupancy(const FrameStats& s) {
    return {occupancy(s.camera_rays.rays, s.camera_rays.packets),
            occupancy(s.shader_rays.shadow_rays, s.shader_rays.shadow_packets),
            occupancy(s.shader_rays.rays, s.shader_rays.packets)};
}

double per_pixel(uint64_t rays, const FrameRecord& r) {
    return double(rays) / double(std::max<size_t>(r.pixels, 1));
}

// Stages of less than a hundredth of a ms are left out.
void print_frame(const FrameRecord& r) {
    const FrameStats& s = r.stats;
    std::printf("frame %lld: %.2f ms =", static_cast<long long>(r.frame), s.total + r.write_ms);
    for_each_stage(r, [](const char* name, double ms) {
        if (ms >= 0.005) std::printf(" %s %.2f", name, ms);
    });
    const Occupancy full = occupancy(s);
    std::printf("; %.2f Mrays/s, %.2f Mpoints/s; %.2f rays a pixel; packets %.0f %% full",
                double(s.rays) / s.total * 1e-3, double(s.shading_points) / s.total * 1e-3,
                per_pixel(s.rays, r), 100 * full.camera);
    if (s.shader_rays.shadow_packets) std::printf(", of shadows %.0f %%", 100 * full.shadow);
    if (s.shader_rays.packets) std::printf(", of shaders %.0f %%", 100 * full.nested);
    if (s.kept_trees) std::printf("; %d trees kept", s.kept_trees);
    std::printf("\n");
}

void print_text(const RenderOptions& options, const RunRecord& run,
                const std::vector<FrameRecord>& frames) {
    jit::CacheStats cache = jit::cache_stats();
    const jit::Target& target = target_of(options);
    for (const FrameRecord& r : frames)
        if (r.state == FrameState::Done) print_frame(r);
    std::printf(
        "target %s (%d lanes), %d threads; load %.1f ms, build %.1f ms, first ray after %.1f "
        "ms; %zu kernels in %.2f ms, %zu bytes of code; peak memory %.1f MB\n",
        target.name, target.lanes, thread_count(), run.load_ms, run.build_ms, run.first_ray_ms,
        cache.kernels, cache.total_ms, cache.code_bytes, double(peak_memory_bytes()) * 1e-6);
    if (run.dice.triangles)
        std::printf("diced to %zu triangles, %zu vertices of %.3g pixels in %.1f ms\n",
                    run.dice.triangles, run.dice.vertices, run.dice.pixels, run.dice.ms);
    if (auto [frames_again, ms] = rediced(frames); frames_again)
        std::printf("diced again for %zu frames in %.1f ms\n", frames_again, ms);
}

using Json = nlohmann::ordered_json;

// Of a frame that was rendered and written.
Json json_of_work(const FrameRecord& r) {
    const FrameStats& s = r.stats;
    const Occupancy full = occupancy(s);
    Json frame = {{"total_ms", s.total}, {"samples", r.samples}};
    for_each_stage(r, [&](const char* name, double ms) { frame[std::string(name) + "_ms"] = ms; });
    frame.update({{"displace_ms", s.displace},
                  {"rays", s.rays},
                  {"rays_per_pixel", per_pixel(s.rays, r)},
                  {"shadow_rays", s.shader_rays.shadow_rays},
                  {"nested_rays", s.shader_rays.rays},
                  {"camera_occupancy", full.camera},
                  {"shadow_occupancy", full.shadow},
                  {"nested_occupancy", full.nested},
                  {"rays_per_second", double(s.rays) / s.total * 1e3},
                  {"shading_points", s.shading_points},
                  {"light_points", s.light_points},
                  {"vertices", s.vertices},
                  {"columns", s.columns},
                  {"points_per_second", double(s.shading_points) / s.total * 1e3},
                  {"refits", s.refits},
                  {"rebuilds", s.rebuilds},
                  {"kept_trees", s.kept_trees},
                  {"non_finite", s.non_finite},
                  {"dice_error", r.dice_error},
                  {"redice_ms", r.redice_ms}});
    return frame;
}

// All frames of the run, those that were not begun too.
Json json_of_frames(const RenderOptions& options, const FrameTimes& frames,
                    const std::vector<FrameRecord>& records) {
    Json rows = Json::array();
    const OutputName name(options.output);
    for (size_t i = 0; i < frames.size(); ++i) {
        const FrameRecord* record = i < records.size() ? &records[i] : nullptr;
        const FrameState state = record ? record->state : FrameState::Aborted;
        Json row = {{"frame", frames[i].first},
                    {"file", options.output.empty() ? "" : name.file(frames[i].first)},
                    {"state", frame_state_name(state)}};
        if (state == FrameState::Done) row.update(json_of_work(*record));
        rows.push_back(std::move(row));
    }
    return rows;
}

void print_json(const RenderOptions& options, const RunRecord& run, const FrameTimes& frames,
                const std::vector<FrameRecord>& records) {
    jit::CacheStats cache = jit::cache_stats();
    const jit::Target& target = target_of(options);
    Json json;
    json["target"] = target.name;
    json["lanes"] = target.lanes;
    json["threads"] = thread_count();
    json["load_ms"] = run.load_ms;
    json["build_ms"] = run.build_ms;
    json["first_ray_ms"] = run.first_ray_ms;
    json["kernels"] = cache.kernels;
    json["compile_ms"] = cache.total_ms;
    json["code_bytes"] = cache.code_bytes;
    json["derivative_values"] = cache.derivative_values;
    json["texture_bytes"] = run.texture_bytes;
    json["peak_memory_bytes"] = peak_memory_bytes();
    json["dice_ms"] = run.dice.ms;
    json["dice_triangles"] = run.dice.triangles;
    json["dice_pixels"] = run.dice.pixels;
    auto [frames_again, again_ms] = rediced(records);
    json["redices"] = frames_again;
    json["redice_ms"] = again_ms;
    json["frames"] = json_of_frames(options, frames, records);
    std::printf("%s\n", json.dump(2).c_str());
}

}  // namespace

void print_stats(const RenderOptions& options, const RunRecord& run, const FrameTimes& frames,
                 const std::vector<FrameRecord>& records) {
    if (options.stats_json)
        print_json(options, run, frames, records);
    else
        print_text(options, run, records);
}

}  // namespace kinora
