// runtime/picture/frame/report.cpp: what a frame tells the user, each thing once.
#include "runtime/picture/frame/report_p.h"

#include <glm/geometric.hpp>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

namespace {

constexpr double kFarSizes = 1e5;                       // docs/decisions.md#precision
constexpr double kLeastSize = 1e-12, kMostSize = 1e12;  // squares of areas are floats

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
        case raytrace::CameraStatus::BadWindow:
            return "its window has no area";
        case raytrace::CameraStatus::Ok:
        case raytrace::CameraStatus::ClipRangeRepaired:
            break;
    }
    return "";
}

}  // namespace

bool report_camera(const Scene& scene, const Pose& pose, raytrace::CameraStatus status,
                   Diagnostics& diagnostics) {
    const CameraSource& source = scene.cameras[pose.camera];
    const CameraDefinition& camera = scene.description->cameras[source.definition];
    if (!raytrace::is_error(status)) {
        if (pose.first_frame && status == raytrace::CameraStatus::ClipRangeRepaired &&
            camera.znear.present() && camera.zfar.present())
            diagnostics.report(Code::CAMERA_CLIP, camera.where, source.name);
        double distance = glm::length(pose.view.eye);
        if (pose.first_frame && distance > kFarSizes * scene.size)
            diagnostics.report(Code::SCENE_FAR, camera.where, distance);
        if (pose.first_frame && !(scene.size >= kLeastSize && scene.size <= kMostSize))
            diagnostics.report(Code::SCENE_SIZE, Location{}, scene.size);
        return true;
    }
    diagnostics.report(Code::CAMERA_OPTICS, camera.where, source.name, status_text(status));
    return false;
}

const MeshDefinition& mesh_of(const Scene& scene, const Shape& shape) {
    return scene.description->meshes[scene.meshes[shape.mesh].definition];
}

namespace {

void report_singular(const Scene& scene, const Node& node, Diagnostics& diagnostics) {
    const NodeDefinition& from = scene.description->nodes[node.definition];
    diagnostics.report(Code::NODE_SINGULAR, from.where, from.id.empty() ? from.name : from.id);
}

// At the shader that gave them, the uppermost where layers are joined.
void report_non_finite(uint64_t count, std::string_view name, const ShaderInstance* look,
                       Diagnostics& diagnostics) {
    Location where;
    if (look && look->shader().definition) where = look->shader().definition->span.where;
    diagnostics.report(Code::SHADER_NON_FINITE, where, count, name);
}

}  // namespace

void report_geometry(const Scene& scene, Pose& pose, const raytrace::AccelUpdate& update,
                     Diagnostics& diagnostics) {
    std::vector<bool>& reported = pose.reported.nodes;
    reported.resize(scene.nodes.size());
    for (size_t n = 0; n < scene.nodes.size() && !pose.all_finite; ++n) {
        if (pose.nodes[n].finite || reported[n]) continue;
        report_singular(scene, scene.nodes[n], diagnostics);
        reported[n] = true;
    }
    auto singular = [&](const Shape& shape) {
        if (pose.nodes[shape.node].finite)
            report_singular(scene, scene.nodes[shape.node], diagnostics);
    };
    if (pose.first_frame)
        for (size_t s = 0; s < scene.shapes.size(); ++s)  // the ray tracer reports those that move
            if (scene.shapes[s].kind == raytrace::GeometryKind::Static &&
                is_singular(pose.shapes[s]))
                singular(scene.shapes[s]);
    for (const auto& issue : update.issues) {
        if (!pose.reported.issues.insert({issue.geometry, issue.issue}).second) continue;
        const Shape& shape = scene.shapes[scene.surfaces[issue.geometry].shape];
        const MeshDefinition& mesh = mesh_of(scene, shape);
        switch (issue.issue) {
            case raytrace::GeometryIssue::SingularMatrix:
                singular(shape);
                break;
            case raytrace::GeometryIssue::BadVertices:
                diagnostics.report(Code::GEOMETRY_ISSUE, mesh.where, mesh.id,
                                   "some vertices are not finite; their triangles are not seen");
                break;
            case raytrace::GeometryIssue::IndexOutOfRange:
                diagnostics.report(Code::GEOMETRY_ISSUE, mesh.where, mesh.id,
                                   "a triangle names a vertex that is not there");
                break;
        }
    }
}

void report_imager(const Scene& scene, size_t bad, FrameStats& stats, Diagnostics& diagnostics) {
    stats.non_finite += bad;
    const ShaderInstance* imager = scene.shader_instances[scene.imager].get();
    if (bad) report_non_finite(bad, imager->shader().name, imager, diagnostics);
}

void report_shading(const Scene& scene, Pose& pose, const ShadingCounters& shading,
                    const raytrace::IntegratorCounters& counters,
                    const raytrace::IntegratorSettings& settings, FrameStats& stats,
                    Diagnostics& diagnostics) {
    if (uint64_t lost = shading.too_deep + counters.too_deep)
        diagnostics.report(Code::LAYER_LIMIT, Location{}, lost, settings.max_layers);
    if (shading.unlit) diagnostics.report(Code::LIGHT_LIMIT, Location{}, kMostLightQuestions);
    if (shading.out_of_rays)
        diagnostics.report(Code::RAY_LIMIT, Location{}, shading.out_of_rays,
                           scene.options.quality.ray_limit);
    if (shading.thinned && !std::exchange(pose.reported.fewer_samples, true))
        diagnostics.report(Code::RAY_SAMPLES, Location{}, shading.thinned,
                           scene.options.quality.ray_limit);
    if (pose.watch_dark > 0) --pose.watch_dark;
    if (shading.dark > shading.seen / 2) {
        pose.watch_dark = 0;
        diagnostics.report(Code::LIGHTS_DARK, Location{});
    }
    scene.textures->report(diagnostics);
    stats.camera_rays = counters.trace;
    stats.shader_rays = shading.trace;
    stats.rays = counters.trace.rays + counters.trace.shadow_rays + shading.trace.rays +
                 shading.trace.shadow_rays;
    stats.shading_points = shading.points;
    stats.light_points = shading.light_points;
    stats.columns = shading.columns;
    stats.non_finite += counters.non_finite;
    if (counters.non_finite == 0) return;
    uint32_t row = counters.non_finite_geometry;  // kNone: where there is no surface
    const ShaderInstance* look =
        row == kNone ? nullptr : scene.shader_instances[scene.surfaces[row].look].get();
    report_non_finite(counters.non_finite, look ? look->name : "the atmosphere", look, diagnostics);
}

}  // namespace kinora
