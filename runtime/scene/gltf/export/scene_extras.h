// runtime/scene/gltf/export/scene_extras.h: what of a scene glTF has no words for: clips, times,
// shaders.
#pragma once

#include "runtime/scene/gltf/curves/curve_writer.h"
#include "runtime/scene/gltf/export/rsl.h"

namespace kinora {

// Before the takes, since parameters move.
void write_scene_shaders(const SceneDescription& description, RslWriter& rsl,
                         GltfDocument& document, LossReport& losses);

// `curves` has written the takes.
void write_scene_extras(const SceneDescription& description, std::span<const Take> takes,
                        const CurveWriter& curves, GltfDocument& document, LossReport& losses);

}  // namespace kinora
