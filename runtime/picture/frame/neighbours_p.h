// runtime/picture/frame/neighbours_p.h: the poses beside that of a frame, for frame.cpp only.
#pragma once

#include "runtime/picture/frame/frame.h"

namespace kinora {

// The view of a pose, by its settings' camera or its own.
raytrace::CameraStatus set_frame_view(const Scene& scene, Pose& pose,
                                      const FrameSettings& settings);

// Brings Pose::neighbours to a frame before and a frame after that time, where an AOV of motion is
// wanted.
void pose_neighbours(const Scene& scene, Pose& pose, double time, const FrameSettings& settings);

}  // namespace kinora
