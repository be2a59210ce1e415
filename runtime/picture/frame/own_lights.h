// runtime/picture/frame/own_lights.h: scenes that their own lights leave black.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora {

struct Pose;
struct Scene;

// Adds the default lights, with LIGHTS_BLACK, where the file's own leave nearly all that the camera
// sees black at each of the times that stand for the range played. Small pictures tell, so it
// depends on the scene and its range alone; one of a lit scene is enough. Scenes stay as they are
// whose lights the options name or are RSL, and under --color legacy. False when a shader cannot be
// compiled. The small pictures are made in `pose`.
bool light_black_scene(Scene& scene, Pose& pose, Diagnostics& diagnostics);

}  // namespace kinora
