// runtime/scene/camera.cpp: the scene's camera from its definition and node.
#include "runtime/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

raytrace::CameraOptics optics_of(const Scene& scene, const Pose& pose) {
    const CameraDefinition& camera =
        scene.description->cameras[scene.cameras[pose.camera].definition];
    auto value = [&](ValueSlot slot) -> std::optional<double> {
        if (!slot.present()) return std::nullopt;
        return pose.values[slot.offset];
    };
    raytrace::CameraOptics optics;
    optics.orthographic = camera.orthographic;
    optics.x = value(camera.x);
    optics.y = value(camera.y);
    optics.aspect = value(camera.aspect);
    // Lengths are in units of the camera's file.
    double unit = unit_of(path_conversion(scene, scene.cameras[pose.camera].node));
    if (camera.orthographic && optics.x) *optics.x *= unit;
    if (camera.orthographic && optics.y) *optics.y *= unit;
    optics.window = camera.window;
    optics.znear = value(camera.znear).value_or(0.0);
    optics.zfar = value(camera.zfar).value_or(0.0);
    if (!camera.orthographic) {
        if (optics.x) optics.x = radians(*optics.x);
        if (optics.y) optics.y = radians(*optics.y);
    }
    return optics;
}

}  // namespace

raytrace::CameraStatus set_view(const Scene& scene, Pose& pose, int width, int height) {
    const CameraSource& source = scene.cameras[pose.camera];
    const CameraDefinition& camera = scene.description->cameras[source.definition];
    const dmat4& world = pose.nodes[source.node].world;
    raytrace::CameraOptics optics = optics_of(scene, pose);
    double scale = glm::length(dvec3(world[2]));  // the clip range is in units of the node
    if (scale > 0 && std::isfinite(scale)) {
        optics.znear *= scale;
        optics.zfar *= scale;
    }
    raytrace::CameraStatus status =
        raytrace::make_camera(optics, world, width, height, scene.origin, scene.size, pose.view);
    // What a file's camera says it sees from and to; a range that had to be repaired says nothing.
    bool both = camera.znear.present() && camera.zfar.present();
    bool repaired = status == raytrace::CameraStatus::ClipRangeRepaired;
    pose.view.clip = camera.clips && !(both && repaired);
    static_assert(kMostClippingPlanes <= raytrace::kMostCameraPlanes);
    for (const dvec4& plane : camera.planes)
        pose.view.planes[pose.view.plane_count++] =
            dvec4(dvec3(plane), plane.w + glm::dot(dvec3(plane), scene.origin));
    return status;
}

raytrace::CameraStatus set_view(const Scene& scene, Pose& pose, const PlacedCamera& camera,
                                int width, int height) {
    raytrace::CameraStatus status = raytrace::make_camera(
        camera.optics, camera.world, width, height, scene.origin, scene.size, pose.view);
    pose.view.clip = false;
    bool repaired = status == raytrace::CameraStatus::ClipRangeRepaired;  // it had none
    return repaired ? raytrace::CameraStatus::Ok : status;
}

std::optional<double> camera_aspect(const Scene& scene) {
    return raytrace::picture_aspect(optics_of(scene, scene.start));
}

}  // namespace kinora
