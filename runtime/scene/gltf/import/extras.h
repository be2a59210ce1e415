// runtime/scene/gltf/import/extras.h: extras of scenes and nodes that kinora-convert writes: axes,
// clips and attributes that glTF has no words for.
#pragma once

#include <optional>
#include <vector>

#include "runtime/scene/gltf/import/rsl.h"

namespace kinora {

// kinora_axes of the one root that kinora-convert puts over a scene with other axes or another
// unit: its matrix is left off, the world is the original's.
struct KinoraAxes {
    int node = -1;
    double meter = 1;  // metres per unit
    UpAxis up = UpAxis::Y;
};
std::optional<KinoraAxes> find_axes(const tinygltf::Model& model, const std::vector<int>& roots);

// The scene's shaders.
void import_scene_shaders(const tinygltf::Model& model, RslExtras& rsl, SceneDescription& out);

// Its times and ranges of clips.
void import_scene_extras(const tinygltf::Model& model, std::span<const uint32_t> clip_of_animation,
                         SceneDescription& out);

// kinora_attributes of a node: an object of numbers, lists of numbers and strings.
void import_attributes(const tinygltf::Value& extras, NodeDefinition& to);

}  // namespace kinora
