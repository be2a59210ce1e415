// runtime/scene/build/emission.h: surfaces whose materials emit, as lights of scenes with indirect
// light.
#pragma once

#include <span>

#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

struct Scene;

// Adds lights for fixed-function materials of COLLADA and glTF that emit: one for each surface, or
// one for all where they are many. A surface that fills much of the scene is none: rays of indirect
// light find it well.
void add_emission_lights(Scene& scene, std::span<const SurfaceUse> uses);

}  // namespace kinora
