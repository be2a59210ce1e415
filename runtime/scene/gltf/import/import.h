// runtime/scene/gltf/import/import.h: a glTF 2.0 scene, .gltf or .glb, to a SceneDescription.
#pragma once

#include <optional>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_source.h"

namespace kinora {

// World space is glTF's: metres, y up. Nodes keep translation, rotation (a quaternion) and scale as
// a stack that channels write. Each animation is a clip; without one all play at once, and where
// two drive the same property the first does.
//
// Light: 1 cd/m2 is 1.0 in the picture, so a white surface that faces a light of 1 lux is 1 / pi
// (KHR_lights_punctual); in files of Blender with lights in watts 683 cd/m2 are. Texture
// coordinates become s = u, t = 1 - v, RSL's.
//
// Findings have the JSON pointer of what they speak of, and its line and column (of a .glb: in its
// JSON chunk). Nothing is returned where there is no scene to show.
std::optional<SceneDescription> import_gltf(const SceneSource& source, const ImportOptions& options,
                                            Diagnostics& diagnostics);

}  // namespace kinora
