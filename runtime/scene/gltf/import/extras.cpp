// runtime/scene/gltf/import/extras.cpp: extras of scenes and nodes that kinora-convert writes.
#include "runtime/scene/gltf/import/extras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/node_tree.h"

namespace kinora {

void import_scene_shaders(const tinygltf::Model& model, RslExtras& rsl, SceneDescription& out) {
    if (model.scenes.empty()) return;
    const size_t index = shown_scene(model);
    out.picture = rsl.picture_shaders(model.scenes[index].extras, fmt::format("/scenes/{}", index));
}

void import_scene_extras(const tinygltf::Model& model, std::span<const uint32_t> clip_of_animation,
                         SceneDescription& out) {
    if (model.scenes.empty()) return;
    const tinygltf::Value& extras = model.scenes[shown_scene(model)].extras;
    auto take = [&](const char* name, std::optional<double>& to) {
        if (std::optional<double> value = number_member(extras, name)) to = value;
    };
    take("kinora_start_time", out.start_time);
    take("kinora_end_time", out.end_time);
    take("kinora_frame_rate", out.frame_rate);
    const tinygltf::Value* clips = member(extras, "kinora_clips");
    for (size_t c = 0; clips && clips->IsArray() && c < clips->ArrayLen(); ++c) {
        const tinygltf::Value& clip = clips->Get(int(c));
        const tinygltf::Value* name = member(clip, "name");
        std::optional<double> start = number_member(clip, "start"),
                              end = number_member(clip, "end");
        std::optional<double> animation = number_member(clip, "animation");
        if (!name || !name->IsString() || !start || !end) continue;
        uint32_t own = animation && *animation >= 0 && *animation < double(clip_of_animation.size())
                           ? clip_of_animation[size_t(*animation)]
                           : kNone;
        if (own != kNone) {
            out.clips[own].start = *start;
            out.clips[own].end = *end;
        } else {
            const std::string& text = name->Get<std::string>();
            out.clips.push_back({text, text, *start, *end});
        }
    }
}

std::optional<KinoraAxes> find_axes(const tinygltf::Model& model, const std::vector<int>& roots) {
    for (int root : roots) {
        if (root < 0) continue;
        const tinygltf::Value* axes = member(model.nodes[size_t(root)].extras, "kinora_axes");
        if (!axes) continue;
        std::string up = string_member(*axes, "up");
        const tinygltf::Value* meter = member(*axes, "meter");
        bool known = up == "X" || up == "Y" || up == "Z";
        if (!known || !meter || !meter->IsNumber()) continue;
        double value = meter->GetNumberAsDouble();
        if (value > 1e-15 && value < 1e15) return KinoraAxes{root, value, UpAxis(up[0] - 'X')};
    }
    return std::nullopt;
}

void import_attributes(const tinygltf::Value& extras, NodeDefinition& to) {
    const tinygltf::Value* attributes = member(extras, "kinora_attributes");
    if (!attributes || !attributes->IsObject()) return;
    for (const std::string& name : attributes->Keys()) {
        const tinygltf::Value& value = attributes->Get(name);
        UserAttribute& attribute = to.attributes.emplace_back();
        attribute.name = name;
        if (value.IsString()) attribute.text = value.Get<std::string>();
        if (value.IsNumber()) attribute.numbers.push_back(value.GetNumberAsDouble());
        for (size_t k = 0; value.IsArray() && k < value.ArrayLen(); ++k)
            if (value.Get(int(k)).IsNumber())
                attribute.numbers.push_back(value.Get(int(k)).GetNumberAsDouble());
    }
}

}  // namespace kinora
