// runtime/picture/frame/neighbours.cpp: a scene posed for what moves, without a tree.
#include <algorithm>

#include "runtime/picture/frame/neighbours_p.h"
#include "runtime/picture/frame/planes_p.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

raytrace::CameraStatus set_frame_view(const Scene& scene, Pose& pose,
                                      const FrameSettings& settings) {
    return settings.camera
               ? set_view(scene, pose, *settings.camera, settings.width, settings.height)
               : set_view(scene, pose, settings.width, settings.height);
}

namespace {

// False where the camera makes no picture.
bool stand(const Scene& scene, Pose& pose, double time, const FrameSettings& settings) {
    evaluate(scene, pose, time);
    pose.shutter = settings.shutter;
    update_transforms(scene, pose);
    const bool seen = !is_error(set_frame_view(scene, pose, settings));
    pose_joints(scene, pose);
    deform(scene, pose);
    if (pose.first_frame) rest_nodes(pose);
    pose.first_frame = false;
    std::fill(pose.changed.begin(), pose.changed.end(), 0);
    return seen;
}

}  // namespace

void pose_neighbours(const Scene& scene, Pose& pose, double time, const FrameSettings& settings) {
    if (!has_plane_of(scene, AovSource::Motion)) return;
    if (!pose.neighbours) pose.neighbours = std::make_shared<NeighbourPoses>(scene);
    NeighbourPoses& beside = *pose.neighbours;
    const double frame = 1 / frames_per_second(scene);
    beside.before.camera = beside.after.camera = pose.camera;
    beside.before_seen = stand(scene, beside.before, time - frame, settings);
    beside.after_seen = stand(scene, beside.after, time + frame, settings);
}

}  // namespace kinora
