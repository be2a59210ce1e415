// runtime/scene/build/lights.h: the lights of a scene.
#pragma once

#include <span>

#include "runtime/scene/build/shapes/node_tree.h"
#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

struct Scene;

// Every occurrence of a light, area lights before others; default lights at the camera where the
// scene has none that light anything, or as the options say. Writes Scene::lights and added. The
// scene has its camera. False after an error: what lies around the scene cannot be read.
bool add_lights(Scene& scene, NodeTree& tree, std::span<const SurfaceUse> uses,
                Diagnostics& diagnostics);

// Whether some of the default lights but the grey world are not hidden.
bool has_default_lights(const SceneDescription& description);

// Adds the default lights to those of a scene that is built, in place of the grey world. Writes
// Scene::lights, added and options.lights. False when a shader cannot be compiled.
bool add_default_lights(Scene& scene, Diagnostics& diagnostics);

}  // namespace kinora
