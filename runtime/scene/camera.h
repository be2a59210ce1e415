// runtime/scene/camera.h: the scene's camera from its definition and node.
#pragma once

#include <optional>

#include "raytrace/camera.h"
#include "runtime/scene/scene.h"

namespace kinora {

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
