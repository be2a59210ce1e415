// runtime/scene/camera.h: a scene's cameras, and what a pose is seen by.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/camera.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct Pose;
struct Scene;

struct CameraSource {
    uint32_t definition = kNone;  // kNone: the default camera
    uint32_t node = kNone;
    std::string name;  // as --camera takes it
};

struct SceneCameras {
    std::vector<CameraSource> cameras;
};

// Sets Pose::view from the scene's camera as its node stands, for a picture of that size.
raytrace::CameraStatus set_view(const Scene& scene, Pose& pose, int width, int height);

// A camera that is no part of the scene; its units and axes are the scene's.
struct PlacedCamera {
    raytrace::CameraOptics optics;  // angles in radians
    dmat4 world{1.0};               // as a camera node's
};
raytrace::CameraStatus set_view(const Scene& scene, Pose& pose, const PlacedCamera& camera,
                                int width, int height);

// Width / height of the scene's camera where its optics say so, at its start.
std::optional<double> camera_aspect(const Scene& scene);

}  // namespace kinora
