// runtime/scene/build/coverage.h: how much of a picture a scene takes, before it can be traced.
#pragma once

#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"

namespace kinora {

inline constexpr double kLittle = 0.03;  // of a picture: less shows next to nothing

// The share of 64 x 64 rays of the camera that meet a triangle of the scene as its shapes stand in
// the pose, whatever these are made of. Once it is `enough` the rest is not looked at.
double covered_share(const SceneShapes& scene, const Pose& pose, const raytrace::Camera& camera,
                     double enough = 1);

}  // namespace kinora
