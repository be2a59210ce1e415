// runtime/scene/build/instances/instances.h: the shader instances of a scene.
#pragma once

#include <span>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

struct Scene;

// Instances of all that the scene's surfaces, lights, volumes and camera have shaders for, lowered
// and compiled. Writes Scene::looks, vertex_instances, volumes, atmosphere, imager and outputs, and
// what surfaces and lights have of their instances. False when a shader cannot be compiled; all
// such have been reported.
bool add_instances(Scene& scene, std::span<const SurfaceUse> uses, Diagnostics& diagnostics);

// The same for lights that came later. Scene::shading is to be made anew.
bool add_light_instances(Scene& scene, Diagnostics& diagnostics);

}  // namespace kinora
