// runtime/kinora/frame_attributes.h: what an EXR's header says of a frame's camera and time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/kinora/frame_list.h"
#include "runtime/scene/images/exr_format.h"

namespace kinora {

struct Pose;
struct Scene;

// worldToCamera and worldToNDC of the pose's view, in the scene's units and axes; chromaticities of
// Rec. 709, in which colors are; framesPerSecond; and timeCode of a frame that has one: from 0 and
// with at most 30 a second.
std::vector<ExrAttribute> frame_attributes(const Scene& scene, const Pose& pose, FrameRate rate,
                                           int64_t frame);

}  // namespace kinora
