// runtime/scene/build/light_watts.h: COLLADA's lights that are in watts.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora {

struct Scene;

// Gives those of Scene::lights that are in watts a brightness for a picture, with a finding. Lights
// of Blender get the fall-off and brightness they have there. Others are scaled together where they
// are far too bright at the middle of the scene. After set_bounds; before the lights' instances.
void scale_watts(Scene& scene, Diagnostics& diagnostics);

}  // namespace kinora
