// runtime/picture/frame/exposure.h: how bright a scene's pictures should be.
#pragma once

#include "runtime/picture/frame/frame.h"

namespace kinora {

struct SceneOptions;

// Stops (powers of two, to a tenth) that bring the pictures of the scene's range to a good
// brightness: four fifths of what is seen stay below 0.6. One number for all frames, which does not
// depend on which of them are rendered; by small pictures of 13 times. 0 where nothing is lit.
double auto_exposure(const Scene& scene, const SceneOptions& options, Pose& pose,
                     const FrameSettings& settings, Diagnostics& diagnostics);

}  // namespace kinora
