// runtime/scene/build/shapes/pose_at.h: Scene::start, the pose of a scene under construction, at a
// time.
#pragma once

namespace kinora {

struct Scene;

// Nodes, joints and vertices where they stand at that time, seconds.
void pose_at(Scene& scene, double time);

// Joints and vertices where they stand as the nodes do.
void pose_now(Scene& scene);

}  // namespace kinora
