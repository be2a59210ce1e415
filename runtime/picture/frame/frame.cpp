// runtime/picture/frame/frame.cpp: the frame loop.
#include "runtime/picture/frame/frame.h"

#include <algorithm>
#include <mutex>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/picture/frame/neighbours_p.h"
#include "runtime/picture/frame/planes_p.h"
#include "runtime/picture/frame/report_p.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/deform.h"
#include "runtime/scene/vertices/dice_error.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

// Times a frame from its construction to its end.
class FrameTimer {
  public:
    explicit FrameTimer(FrameStats& stats) : stats_(stats), running_(clock_) {}
    ~FrameTimer() {
        stats_.total = watch_.ms();
        stats_.stages = stage_ms(clock_.ticks(), tiles, thread_count(), stats_.total);
    }
    FrameTimer(const FrameTimer&) = delete;
    StageTicks tiles;  // summed over the threads

  private:
    FrameStats& stats_;
    Stopwatch watch_;
    StageClock clock_;
    RunningClock running_;
};

void begin_shading(const Scene& scene, Pose& pose, const FrameSettings& settings,
                   raytrace::Film& film) {
    if (!pose.shading) pose.shading = std::make_shared<Shading>(scene, pose);
    prepare_planes(scene, film);
    if (film.is_band && settings.band_rows == 0) film.resize(pose.view.width, pose.view.height);
    pose.shading->stop_by(settings.stop);
    ShadingInsight insight = settings.insight;
    if (!insight.costs && has_plane_of(scene, AovSource::Cost))
        insight.costs = &pose.shading->costs();
    pose.shading->show(insight);
    if (insight.costs) insight.costs->start(pose.view.width, pose.view.height);
    if (insight.first)
        insight.first->start(pose.view.width, pose.view.height, scene.shader_instances.size());
    StageScope stage(Stage::Kernels);
    pose.shading->begin_frame(settings.integrator.seed, settings.integrator.max_layers);
}

// What the film holds of the picture, without the imager.
bool trace_film(Pose& pose, const FrameSettings& settings, raytrace::Film& film,
                raytrace::IntegratorCounters& counters, const raytrace::Progress* progress) {
    raytrace::IntegratorSettings integrator = settings.integrator;
    float gain = float(settings.gain);
    if (integrator.background) *integrator.background /= gain;  // it is no part of the scene
    bool whole = raytrace::integrate(pose.accel, pose.view, *pose.shading, film, integrator,
                                     pose.scratch, counters, progress);
    StageScope stage(Stage::Film);
    if (gain != 1)
        for (vec4& pixel : film.rgba) pixel = vec4(vec3(pixel) * gain, pixel.w);
    if (settings.gamma != 1) {
        const vec3 power(float(1 / settings.gamma));
        for (vec4& pixel : film.rgba)
            pixel = vec4(glm::pow(glm::max(vec3(pixel), vec3(0)), power), pixel.w);
    }
    return whole;
}

// The same with the imager, which adds to `bad` the pixels that it left not finite.
bool make_film(const Scene& scene, Pose& pose, const FrameSettings& settings, raytrace::Film& film,
               raytrace::IntegratorCounters& counters, size_t& bad,
               const raytrace::Progress* progress) {
    if (!trace_film(pose, settings, film, counters, progress)) return false;
    if (has_plane_of(scene, AovSource::Cost)) {
        const PixelCosts* costs = settings.insight.costs;
        fill_costs(scene, costs ? *costs : pose.shading->costs(),
                   settings.integrator.samples_per_pixel, film);
    }
    if (scene.imager == kNone) return true;
    StageScope stage(Stage::Imager);
    const size_t found = pose.shading->run_imager(film, settings.integrator.nan);
    film.non_finite += found;
    bad += found;
    return !pose.shading->stopped();  // its kernels end early too
}

// Band by band, each handed on before the next one takes its memory.
bool make_bands(const Scene& scene, Pose& pose, const FrameSettings& settings, raytrace::Film& film,
                raytrace::IntegratorCounters& counters, size_t& bad,
                const raytrace::Progress* progress) {
    CHECK_EQ(settings.band_rows % settings.integrator.tile, 0);
    const int height = pose.view.height,
              bands = (height + settings.band_rows - 1) / settings.band_rows;
    for (int band = 0; band < bands; ++band) {
        const int first = band * settings.band_rows;
        film.hold_band(pose.view.width, first, std::min(settings.band_rows, height - first));
        auto counted = [&](int done, int total) {
            return (*progress)(band * total + done, bands * total);
        };
        raytrace::Progress of_band(counted);
        if (!make_film(scene, pose, settings, film, counters, bad, progress ? &of_band : nullptr) ||
            !settings.on_band(film))
            return false;
    }
    return true;
}

// The tree of a scene in which nothing moves.
const raytrace::AccelUpdate& take_still_tree(StillTree& still, Pose& pose) {
    std::lock_guard lock(still.mutex);
    if (!still.accel) {
        pose.accel.update(pose.rows);
        still.accel = pose.accel.shared();
    }
    pose.accel = still.accel->shared();
    return pose.accel.last_update();
}

const raytrace::AccelUpdate& update_tree(const Scene& scene, Pose& pose) {
    if (!scene.still_tree)
        return pose.first_frame ? pose.accel.update(pose.rows)
                                : pose.accel.update(pose.rows, scene.moving.surfaces);
    static const raytrace::AccelUpdate nothing;
    return pose.first_frame ? take_still_tree(*scene.still_tree, pose) : nothing;
}

}  // namespace

bool pose_frame(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                FrameStats& stats, Diagnostics& diagnostics) {
    {
        StageTimer timer(stats.animate);
        StageScope stage(Stage::Animate);
        evaluate(scene, pose, time);
        pose.shutter = settings.shutter;
        update_transforms(scene, pose);
    }
    const raytrace::CameraStatus camera = set_frame_view(scene, pose, settings);
    if (!report_camera(scene, pose, camera, diagnostics)) return false;
    {
        StageTimer timer(stats.skin);
        StageScope stage(Stage::Skin);
        pose_joints(scene, pose);
        stats.dice_error = dice_error(*scene.description, scene, pose);
        stats.too_coarse =
            settings.most_dice_error > 0 && stats.dice_error > settings.most_dice_error;
        // What changed stays marked, so that the next frame moves it.
        if (stats.too_coarse) return false;
        stats.displace = deform(scene, pose, &stats.vertices);
        if (pose.first_frame) rest_nodes(pose);
        for (uint32_t s : scene.moving.shapes)
            if (const Shape& shape = scene.shapes[s]; shape.vertex_work)
                shape.vertex_work->report(mesh_of(scene, shape), *pose.shapes[s].vertex_state,
                                          diagnostics);
    }
    {
        StageTimer timer(stats.skin);
        StageScope stage(Stage::Skin);
        pose_neighbours(scene, pose, time, settings);
    }
    {
        StageTimer timer(stats.refit);
        StageScope stage(Stage::Refit);
        const raytrace::AccelUpdate& update = update_tree(scene, pose);
        stats.rows_compared = update.compared;
        stats.refits = update.refits;
        stats.rebuilds = update.rebuilds + update.low_rebuilds;
        stats.kept_trees = update.kept;
        if (pose.first_frame || !pose.all_finite || !update.issues.empty())
            report_geometry(scene, pose, update, diagnostics);
    }
    pose.first_frame = false;
    std::fill(pose.changed.begin(), pose.changed.end(), 0);
    return true;
}

bool render_frame(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                  raytrace::Film& film, FrameStats& stats, Diagnostics& diagnostics,
                  const raytrace::Progress* progress) {
    stats = {};
    FrameTimer timer(stats);
    if (!pose_frame(scene, pose, time, settings, stats, diagnostics)) return false;
    raytrace::IntegratorCounters counters;
    begin_shading(scene, pose, settings, film);
    size_t bad = 0;
    auto make = settings.band_rows > 0 ? make_bands : make_film;
    bool whole = make(scene, pose, settings, film, counters, bad, progress);
    timer.tiles = counters.stages;
    if (bad) report_imager(scene, bad, stats, diagnostics);
    ShadingCounters shading = pose.shading->end_frame(diagnostics, whole);
    report_shading(scene, pose, shading, counters, settings.integrator, stats, diagnostics);
    return whole;
}

bool render_trial(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                  raytrace::Film& film, Diagnostics& diagnostics, ShadingCounters* shading) {
    FrameStats stats;
    if (!pose_frame(scene, pose, time, settings, stats, diagnostics)) return false;
    raytrace::IntegratorCounters counters;
    begin_shading(scene, pose, settings, film);
    bool whole = trace_film(pose, settings, film, counters, nullptr);
    ShadingCounters counted = pose.shading->drop_frame(diagnostics);
    if (shading) *shading = counted;
    return whole;
}

}  // namespace kinora
