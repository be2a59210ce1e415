// runtime/scene/build/displacement/displacement.h: displacement and transformation of meshes.
#pragma once

#include <atomic>
#include <span>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/build/displacement/closer_view.h"
#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

struct Scene;

// Dices meshes whose shaders move vertices, and moves these, once or ready to be at each frame.
// Writes Scene::dice and watched, and the meshes, morphs and shapes that are displaced. `closer`:
// the scene is built again, for that view beside those of the range played (null: it is not). Once
// `stop` (null: never) is true the result is not to be used.
void displace(Scene& scene, std::span<const SurfaceUse> uses, const CloserView* closer,
              const std::atomic<bool>* stop, Diagnostics& diagnostics);

}  // namespace kinora
