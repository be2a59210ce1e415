// runtime/picture/shading/shading.cpp: the objects that shade, and the course of a frame.
#include "runtime/picture/shading/shading.h"
#include "runtime/picture/shading/lighting/light_aims.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/picture/shading/bake.h"
#include "runtime/picture/shading/dome.h"
#include "runtime/picture/shading/grid_host.h"
#include "runtime/picture/shading/hit_planes.h"
#include "runtime/picture/shading/hit_shader.h"
#include "runtime/picture/shading/imager.h"
#include "runtime/picture/shading/light_layers.h"
#include "runtime/picture/shading/lighting/lamps.h"
#include "runtime/picture/shading/print.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/picture/shading/rays/map_tables.h"
#include "runtime/picture/shading/relight.h"
#include "runtime/picture/shading/transmission.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Each object is made of those before it. Kernels alone lead back up: they call services.
struct Shading::Objects {
    Objects(const Scene& scene, const Pose& pose) : frame(scene, pose) {}

    ShadingFrame frame;
    ThreadMemories threads;
    KernelRunner kernels{frame, services};
    LightRecords lights{frame, kernels};
    Volumes volumes{frame, kernels, lights};
    Transmission transmission{frame, kernels, lights, volumes};
    Dome dome{frame, kernels};
    Lamps lamps{frame, kernels, lights};
    HitShader hits{frame, kernels, lights, transmission, volumes, lamps, dome};
    MapTables maps{*frame.resources.textures};
    RayServices rays{frame, hits.queue(), maps};
    GatherRays gathers{frame, hits, hits.queue(), maps};
    Imager imager{frame, threads, kernels};
    Prints prints;
    Bakes bakes{frame.resources, frame.pose};
    GridServices services{lights, rays, gathers, prints, bakes};
    bool aims_reported = false, layers_reported = false;
    // What the scene's shaders need of all frames: these do not look at each of them for it.
    std::vector<bool> looks_run;  // by look: see looks_that_run()
    // The others run once: volumes ask all lights, and see what those held then.
    bool all_ran = false;
    bool reads_footprints = false;
    bool fills_space = false;  // an atmosphere of the background, or an exterior
    bool has_mattes = false;
    PixelCosts costs;

    void report_layers(Diagnostics& diagnostics) {
        LayerErrors all;
        for (const auto& thread : threads)
            for (size_t look = 0; look < thread->layer_errors.of_look.size(); ++look)
                all.add(look, thread->layer_errors.of_look[look]);
        if (!layers_reported)
            layers_reported = report_layer_errors(frame.shaders, all, diagnostics);
    }

    ShadingCounters counted() const {  // by all threads, in this frame
        ShadingCounters total;
        for (const auto& thread : threads) total += thread->counters;
        return total;
    }
};

namespace {

// Looks that run in a frame: all but those of lights that no shader asks for.
std::vector<bool> looks_that_run(const Scene& scene, const LightRecords& lights) {
    std::vector<bool> run(scene.shader_instances.size(), true);
    for (const LightSource& light : scene.lights) run[light.look] = false;
    for (size_t l = 0; l < scene.lights.size(); ++l)
        if (lights.asked(l)) run[scene.lights[l].look] = true;
    return run;
}

}  // namespace

Shading::Shading(const Scene& scene, const Pose& pose) {
    objects_ = std::make_unique<Objects>(scene, pose);
    const auto& looks = scene.shader_instances;
    ShadingFrame& frame = objects_->frame;
    frame.instances.resize(looks.size());
    frame.any_transparent = std::ranges::any_of(looks, [](const auto& look) {
        return look->kind == ShaderInstanceKind::Surface && look->opacity.has_value();
    });
    frame.lights_shoot = std::ranges::any_of(
        scene.lights, [&](const LightSource& light) { return shoots_rays(*looks[light.look]); });
    objects_->looks_run = looks_that_run(scene, objects_->lights);
    hash_names(scene, frame);
    frame.relit = wants_relight(scene);
    frame.layers = find_light_layers(frame);
    frame.layers_read_bare_light =
        std::ranges::any_of(frame.layers, [](const LightLayer& layer) { return layer.part.bare; });
    objects_->reads_footprints = kinora::reads_footprints(scene);
    objects_->has_mattes = std::ranges::any_of(scene.surfaces, &Surface::matte);
    // Files that bring their picture are RIB, where an atmosphere is a surface's attribute.
    const bool surfaces_alone = scene.description && scene.description->file_picture;
    objects_->fills_space =
        (scene.atmosphere != kNone && !surfaces_alone) ||
        std::ranges::any_of(looks, [](const auto& look) { return look->exterior; });
}
Shading::~Shading() = default;

namespace {

// Brings the looks that run, or all, to the pose's time.
void update_looks(ShadingFrame& frame, const std::vector<bool>& run, bool all) {
    FrameContext context{
        .scene = frame.scene, .nodes = frame.nodes, .pose = frame.pose, .stop = frame.stop};
    for (size_t l = 0; l < run.size(); ++l)
        if (all || run[l]) frame.shaders.shader_instances[l]->update(context, frame.instances[l]);
}

void set_view(ShadingFrame& frame) {
    const Scene& scene = frame.scene;
    const raytrace::Camera& view = frame.pose.view;
    frame.camera_from_accel = mat3(glm::transpose(dmat3(view.right, view.up, view.forward)));
    frame.eye = vec3(view.eye);
    const CameraSource& camera = scene.cameras[frame.pose.camera];
    bool has_end = scene.description->cameras[camera.definition].zfar.present();
    frame.far_distance = has_end ? float(view.zfar) : float(glm::length(view.eye) + scene.size);
}

// du and dv are the footprint's size; bake3d takes it for points without a radius.
bool reads_footprints(const ShaderInstance& look) {
    static const jit::ServiceFn bake = find_service("bake3d");
    auto reads = [](const BoundKernel& kernel) {
        return std::ranges::any_of(kernel.columns,
                                   [](uint16_t c) { return c == kColDu || c == kColDv; }) ||
               std::ranges::count(kernel.services, bake) > 0;
    };
    return reads(look.full) || (look.opacity && reads(*look.opacity));
}

}  // namespace

bool reads_footprints(const SceneShaders& scene) {
    return std::ranges::any_of(scene.shader_instances,
                               [](const auto& look) { return reads_footprints(*look); });
}

void Shading::begin_frame(uint32_t seed, int max_layers, bool all_inputs) {
    ShadingFrame& frame = objects_->frame;
    ThreadMemories& threads = objects_->threads;
    frame.seed = seed;
    frame.max_layers = max_layers;
    while (threads.size() < size_t(thread_count()))
        threads.push_back(std::make_unique<ThreadMemory>(threads.size()));
    frame.footprints = all_inputs || objects_->reads_footprints;
    for (auto& thread : threads) {
        thread->counters = {};
        thread->footprints = frame.footprints;
    }
    objects_->kernels.begin_frame(threads.size());
    objects_->gathers.begin_frame(threads.size());
    objects_->prints.begin_frame(threads.size());
    objects_->bakes.begin_frame(threads.size());
    const bool all = !std::exchange(objects_->all_ran, true) || all_inputs;
    update_looks(frame, objects_->looks_run, all);
    set_view(frame);
    objects_->lights.begin_frame(all_inputs, *threads[0]);
    frame.miss_distance =
        objects_->fills_space || objects_->dome.stands() ? frame.far_distance : 0.0f;
}

void Shading::stop_by(const std::atomic<int>* flag) {
    objects_->frame.stop = flag;
}
PixelCosts& Shading::costs() {
    return objects_->costs;
}

void Shading::show(const ShadingInsight& insight) {
    objects_->frame.insight = insight;
}
bool Shading::stopped() const {
    return objects_->frame.stopped();
}

ShadingCounters Shading::end_frame(Diagnostics& diagnostics, bool whole) {
    objects_->prints.flush(objects_->frame.shaders, objects_->frame.resources.options.print,
                           diagnostics);
    objects_->bakes.flush(whole, diagnostics);
    objects_->kernels.report_faults(diagnostics);
    objects_->report_layers(diagnostics);
    if (!std::exchange(objects_->aims_reported, true))
        report_aims(objects_->frame, objects_->lights.bindings(), diagnostics);
    objects_->frame.insight = {};  // what it fills need not be there any more
    return objects_->counted();
}

ShadingCounters Shading::drop_frame(Diagnostics& diagnostics) {
    objects_->prints.drop();
    objects_->bakes.flush(false, diagnostics);
    objects_->frame.insight = {};
    return objects_->counted();
}

void Shading::shade(const raytrace::HitBatch& hits, int thread, raytrace::ShadeResult& result) {
    objects_->hits.shade(hits, {}, *objects_->threads[size_t(thread)], result);
    fill_hit_planes(objects_->frame, hits, result);
}

bool Shading::reads_footprints() const {
    return objects_->frame.footprints;
}

float Shading::miss_distance() const {
    const bool sees = objects_->fills_space || objects_->dome.is_behind_picture();
    return sees ? objects_->frame.miss_distance : 0.0f;
}

void Shading::shade_misses(const raytrace::HitBatch& ends, int thread,
                           raytrace::ShadeResult& result) {
    objects_->hits.shade_misses(ends, {}, *objects_->threads[size_t(thread)], result);
}

uint32_t Shading::medium_behind(const raytrace::HitBatch& hits, size_t k) const {
    return kinora::medium_behind(objects_->frame, hits, k);
}

bool Shading::has_mattes() const {
    return objects_->has_mattes;
}

bool Shading::is_matte(const raytrace::HitBatch& hits, size_t k) const {
    return objects_->frame.shapes.surfaces[hits.geometry[k]].matte;
}

size_t Shading::run_imager(raytrace::Film& film, raytrace::NanPolicy nan) {
    return objects_->imager.run(film, nan);
}

}  // namespace kinora
