// runtime/gltf/import/extras.cpp: extras of scenes, cameras, lights and nodes that kinora-convert
// writes: shaders, clips and attributes that glTF has no words for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/description/findings.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

const tinygltf::Value* member(const tinygltf::Value& object, const char* name) {
    return object.IsObject() && object.Has(name) ? &object.Get(name) : nullptr;
}

std::optional<double> number(const tinygltf::Value& object, const char* name) {
    const tinygltf::Value* value = member(object, name);
    if (!value || !value->IsNumber() || !std::isfinite(value->GetNumberAsDouble()))
        return std::nullopt;
    return value->GetNumberAsDouble();
}

}  // namespace

// kinora_rsl of a scene or a camera: "atmosphere" and "imagers".
PictureShaders GltfImport::picture_shaders(const tinygltf::Value& extras,
                                           const std::string& pointer) {
    PictureShaders picture;
    const tinygltf::Value* rsl = member(extras, "kinora_rsl");
    if (!rsl) return picture;
    std::string place = pointer + "/extras/kinora_rsl";
    picture.atmosphere = rsl_stage(*rsl, "atmosphere", rsl::ShaderKind::Volume, place);
    picture.imagers = rsl_stage(*rsl, "imagers", rsl::ShaderKind::Imager, place);
    return picture;
}

// kinora_rsl of a light: "light", and "ambient" where it has no place. False where there is none.
bool GltfImport::import_rsl_light(const tinygltf::Light& light, const std::string& pointer,
                                  LightDefinition& to) {
    const tinygltf::Value* rsl = member(light.extras, "kinora_rsl");
    if (!rsl) return false;
    std::vector<ShaderUse> uses =
        rsl_stage(*rsl, "light", rsl::ShaderKind::Light, pointer + "/extras/kinora_rsl");
    if (uses.empty()) return false;
    to.shader = std::move(uses.front());
    const tinygltf::Value* ambient = member(*rsl, "ambient");
    to.ambient = ambient && ambient->IsBool() && ambient->Get<bool>();
    const tinygltf::Value* shadows = member(*rsl, "shadows");
    if (shadows && shadows->IsBool()) to.shadows = shadows->Get<bool>();
    return true;
}

void GltfImport::import_scene_extras() {
    if (model_.scenes.empty()) return;
    size_t index = size_t(std::max(model_.defaultScene, 0));
    if (index >= model_.scenes.size()) index = 0;
    const tinygltf::Value& extras = model_.scenes[index].extras;
    out_.picture = picture_shaders(extras, fmt::format("/scenes/{}", index));
    auto take = [&](const char* name, std::optional<double>& to) {
        if (std::optional<double> value = number(extras, name)) to = value;
    };
    take("kinora_start_time", out_.start_time);
    take("kinora_end_time", out_.end_time);
    take("kinora_frame_rate", out_.frame_rate);
    const tinygltf::Value* clips = member(extras, "kinora_clips");
    for (size_t c = 0; clips && clips->IsArray() && c < clips->ArrayLen(); ++c) {
        const tinygltf::Value& clip = clips->Get(int(c));
        const tinygltf::Value* name = member(clip, "name");
        std::optional<double> start = number(clip, "start"), end = number(clip, "end");
        if (name && name->IsString() && start && end)
            out_.clips.push_back({name->Get<std::string>(), *start, *end});
    }
}

// kinora_axes of the one root that kinora-convert puts over a scene with other axes or another
// unit: its matrix is left off, the world is the original's.
void GltfImport::find_axes(const std::vector<int>& roots) {
    for (int root : roots) {
        if (root < 0) continue;
        const tinygltf::Value* axes = member(model_.nodes[size_t(root)].extras, "kinora_axes");
        const tinygltf::Value* up = axes ? member(*axes, "up") : nullptr;
        const tinygltf::Value* meter = axes ? member(*axes, "meter") : nullptr;
        if (!up || !up->IsString() || !meter || !meter->IsNumber()) continue;
        std::string name = up->Get<std::string>();
        double value = meter->GetNumberAsDouble();
        bool known = name == "X" || name == "Y" || name == "Z";
        if (!known || !(value > 1e-15 && value < 1e15)) continue;
        axes_node_ = root;
        axes_meter_ = value;
        if (!options_.meter) out_.meter = value;
        if (!options_.up_axis) out_.up_axis = UpAxis(name[0] - 'X');
        return;
    }
}

// kinora_attributes of a node: an object of numbers, lists of numbers and strings.
void GltfImport::import_attributes(const tinygltf::Value& extras, NodeDefinition& to) {
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
