// runtime/frame.cpp: the frame loop.
#include "runtime/frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "rsl/ast.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/deform.h"
#include "runtime/dice_error.h"
#include "runtime/findings.h"
#include "runtime/texture_store.h"
#include "runtime/transforms.h"
#include "runtime/vertex_work.h"

namespace kinora {

namespace {

constexpr double kFarSizes = 1e5;                       // DESIGN.md decision 18
constexpr double kLeastSize = 1e-12, kMostSize = 1e12;  // squares of areas are floats

raytrace::CameraOptics optics_of(const Scene& scene) {
    const CameraDefinition& camera =
        scene.description->cameras[scene.cameras[scene.camera].definition];
    auto value = [&](ValueSlot slot) -> std::optional<double> {
        if (!slot.present()) return std::nullopt;
        return scene.values[slot.offset];
    };
    raytrace::CameraOptics optics;
    optics.orthographic = camera.orthographic;
    optics.x = value(camera.x);
    optics.y = value(camera.y);
    optics.aspect = value(camera.aspect);
    // Lengths are in units of the camera's file.
    double unit = unit_of(path_conversion(scene, scene.cameras[scene.camera].node));
    if (camera.orthographic && optics.x) *optics.x *= unit;
    if (camera.orthographic && optics.y) *optics.y *= unit;
    optics.znear = value(camera.znear).value_or(0.0);
    optics.zfar = value(camera.zfar).value_or(0.0);
    if (!camera.orthographic) {
        if (optics.x) optics.x = radians(*optics.x);
        if (optics.y) optics.y = radians(*optics.y);
    }
    return optics;
}

const char* status_text(raytrace::CameraStatus status) {
    switch (status) {
        case raytrace::CameraStatus::FieldOfViewOutOfRange:
            return "the field of view must lie between 0 and 180 degrees";
        case raytrace::CameraStatus::MagnificationNotPositive:
            return "the magnification must be positive";
        case raytrace::CameraStatus::AspectNotPositive:
            return "the aspect ratio must be positive";
        case raytrace::CameraStatus::BadMatrix:
            return "its node's matrix has no three axes";
        case raytrace::CameraStatus::BadPicture:
            return "the picture must have at least one pixel";
        case raytrace::CameraStatus::Ok:
        case raytrace::CameraStatus::ClipRangeRepaired:
            break;
    }
    return "";
}

}  // namespace

raytrace::CameraStatus place_camera(Scene& scene, int width, int height) {
    const CameraSource& source = scene.cameras[scene.camera];
    const CameraDefinition& camera = scene.description->cameras[source.definition];
    const dmat4& world = scene.nodes[source.node].world;
    raytrace::CameraOptics optics = optics_of(scene);
    double scale = glm::length(dvec3(world[2]));  // the clip range is in units of the node
    if (scale > 0 && std::isfinite(scale)) {
        optics.znear *= scale;
        optics.zfar *= scale;
    }
    raytrace::CameraStatus status =
        raytrace::make_camera(optics, world, width, height, scene.origin, scene.size, scene.view);
    // What a file's camera says it sees from and to; a range that had to be repaired says nothing.
    bool both = camera.znear.present() && camera.zfar.present();
    bool repaired = status == raytrace::CameraStatus::ClipRangeRepaired;
    scene.view.clip = camera.clips && !(both && repaired);
    return status;
}

namespace {

bool update_camera(Scene& scene, const FrameSettings& settings, Diagnostics& diagnostics) {
    const CameraSource& source = scene.cameras[scene.camera];
    raytrace::CameraStatus status = place_camera(scene, settings.width, settings.height);
    const CameraDefinition& camera = scene.description->cameras[source.definition];
    if (!raytrace::is_error(status)) {
        if (scene.first_frame && status == raytrace::CameraStatus::ClipRangeRepaired &&
            camera.znear.present() && camera.zfar.present())
            diagnostics.report(Code::CAMERA_CLIP, camera.where, source.name);
        double distance = glm::length(scene.view.eye);
        if (scene.first_frame && distance > kFarSizes * scene.size)
            diagnostics.report(Code::SCENE_FAR, camera.where, distance);
        if (scene.first_frame && !(scene.size >= kLeastSize && scene.size <= kMostSize))
            diagnostics.report(Code::SCENE_SIZE, Location{}, scene.size);
        return true;
    }
    diagnostics.report(Code::CAMERA_OPTICS, camera.where, source.name, status_text(status));
    return false;
}

const std::string& mesh_id(const Scene& scene, const Shape& shape) {
    return scene.description->meshes[scene.meshes[shape.mesh].definition].id;
}

void report_singular(const Scene& scene, const Node& node, Diagnostics& diagnostics) {
    const NodeDefinition& from = scene.description->nodes[node.definition];
    diagnostics.report(Code::NODE_SINGULAR, Location{}, from.id.empty() ? from.name : from.id);
}

// Each thing once, in the first frame that has it.
void report_geometry(Scene& scene, const raytrace::AccelUpdate& update, Diagnostics& diagnostics) {
    for (Node& node : scene.nodes) {
        if (scene.all_finite) break;
        if (!node.finite && !node.told) report_singular(scene, node, diagnostics);
        node.told |= !node.finite;
    }
    auto singular = [&](const Shape& shape) {
        if (scene.nodes[shape.node].finite)
            report_singular(scene, scene.nodes[shape.node], diagnostics);
    };
    if (scene.first_frame)
        for (const Shape& shape : scene.shapes)  // those that move are the ray tracer's to tell
            if (shape.kind == raytrace::GeometryKind::Static && is_singular(shape)) singular(shape);
    for (const auto& issue : update.issues) {
        if (!scene.told_issues.insert({issue.geometry, issue.issue}).second) continue;
        const Shape& shape = scene.shapes[scene.surfaces[issue.geometry].shape];
        const std::string& mesh = mesh_id(scene, shape);
        switch (issue.issue) {
            case raytrace::GeometryIssue::SingularMatrix:
                singular(shape);
                break;
            case raytrace::GeometryIssue::BadVertices:
                diagnostics.report(Code::GEOMETRY_ISSUE, Location{}, mesh,
                                   "some vertices are not finite; their triangles are not seen");
                break;
            case raytrace::GeometryIssue::IndexOutOfRange:
                diagnostics.report(Code::GEOMETRY_ISSUE, Location{}, mesh,
                                   "a triangle names a vertex that is not there");
                break;
        }
    }
}

// At the shader that gave them, the uppermost where layers are joined.
void report_non_finite(uint64_t count, std::string_view name, const Look* look,
                       Diagnostics& diagnostics) {
    Location where;
    if (look && look->shader().definition) where = look->shader().definition->place.where;
    diagnostics.report(Code::SHADER_NON_FINITE, where, count, name);
}

// The film's planes are those of the scene's outputs.
void prepare_planes(const Scene& scene, raytrace::Film& film) {
    bool same = film.aovs.size() == scene.outputs.size();
    for (size_t p = 0; same && p < film.aovs.size(); ++p)
        same = film.aovs[p].name == scene.outputs[p].name;
    if (same) return;
    film.aovs.clear();
    for (const OutputPlane& plane : scene.outputs) {
        film.add_aov(plane.name);
        film.aovs.back().in_file = plane.in_file;
    }
}

}  // namespace

std::optional<double> camera_aspect(const Scene& scene) {
    return raytrace::picture_aspect(optics_of(scene));
}

bool pose_frame(Scene& scene, double time, const FrameSettings& settings, FrameStats& stats,
                Diagnostics& diagnostics) {
    {
        StageTimer timer(stats.animate);
        anim::evaluate(scene.description->animation, time, scene.values, scene.changed);
        scene.time = time;
        scene.shutter = settings.shutter;
        update_transforms(scene);
    }
    if (!update_camera(scene, settings, diagnostics)) return false;
    {
        StageTimer timer(stats.skin);
        pose(scene);
        stats.dice_error = dice_error(scene);
        stats.too_coarse =
            settings.most_dice_error > 0 && stats.dice_error > settings.most_dice_error;
        // What changed stays marked, so that the next frame moves it.
        if (stats.too_coarse) return false;
        stats.displace = deform(scene);
        for (Shape& shape : scene.shapes)
            if (shape.vertex_work) shape.vertex_work->report(mesh_id(scene, shape), diagnostics);
    }
    {
        StageTimer timer(stats.refit);
        const raytrace::AccelUpdate& update = scene.accel.update(scene.geometry);
        stats.refits = update.refits;
        stats.rebuilds = update.rebuilds + update.low_rebuilds;
        if (scene.first_frame || !scene.all_finite || !update.issues.empty())
            report_geometry(scene, update, diagnostics);
    }
    scene.first_frame = false;
    std::fill(scene.changed.begin(), scene.changed.end(), 0);
    return true;
}

bool render_frame(Scene& scene, double time, const FrameSettings& settings, raytrace::Film& film,
                  FrameStats& stats, Diagnostics& diagnostics, const raytrace::Progress* progress) {
    stats = {};
    StageTimer total(stats.total);
    if (!pose_frame(scene, time, settings, stats, diagnostics)) return false;
    prepare_planes(scene, film);
    scene.shading->stop_by(settings.stop);
    scene.shading->begin_frame(time, settings.shutter, settings.integrator.seed,
                               settings.integrator.max_layers);
    raytrace::IntegratorCounters counters;
    bool whole = raytrace::integrate(scene.accel, scene.view, *scene.shading, film,
                                     settings.integrator, scene.scratch, counters, progress);
    if (whole && scene.imager != kNone) {
        size_t bad = scene.shading->run_imager(film, settings.integrator.nan);
        film.non_finite += bad;
        stats.non_finite = bad;
        if (bad)
            report_non_finite(bad, scene.looks[scene.imager]->shader().name,
                              scene.looks[scene.imager].get(), diagnostics);
    }
    ShadingCounters shading = scene.shading->end_frame(diagnostics, whole);
    if (uint64_t lost = shading.too_deep + counters.too_deep)
        diagnostics.report(Code::LAYER_LIMIT, Location{}, lost, settings.integrator.max_layers);
    if (shading.unlit) diagnostics.report(Code::LIGHT_LIMIT, Location{}, kMostLightPlaces);
    scene.textures->report(diagnostics);
    stats.trace = counters.trace_ms / thread_count();
    stats.shade = counters.shade_ms / thread_count();
    stats.rays = counters.trace.rays + counters.trace.shadow_rays + shading.trace.rays +
                 shading.trace.shadow_rays;
    stats.shading_points = shading.points;
    stats.non_finite += counters.non_finite;
    if (counters.non_finite) {
        uint32_t row = counters.non_finite_geometry;  // kNone: where there is no surface
        const Look* look = row == kNone ? nullptr : scene.looks[scene.surfaces[row].look].get();
        report_non_finite(counters.non_finite, look ? look->name : "the atmosphere", look,
                          diagnostics);
    }
    return whole;
}

}  // namespace kinora
