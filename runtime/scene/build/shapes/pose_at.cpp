// runtime/scene/build/shapes/pose_at.cpp: the pose of a scene under construction at a time.
#include "runtime/scene/build/shapes/pose_at.h"

#include "runtime/scene/scene.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

void pose_at(Scene& scene, double time) {
    evaluate_anew(scene, scene.start, time);
    pose_now(scene);
}

void pose_now(Scene& scene) {
    pose_joints(scene, scene.start);
    deform(scene, scene.start);
}

}  // namespace kinora
