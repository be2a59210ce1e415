// runtime/scene/gltf/import/lights.cpp: KHR_lights_punctual as lights in RSL.
#include "runtime/scene/gltf/import/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/gltf/import/values.h"

namespace kinora {

namespace {

constexpr double kLumensPerWatt = 683;  // Blender's exporter, its lighting mode "Standard"

// What RSL in extras stands in place of.
constexpr const char* kValues[] = {"/color", "/intensity", "/range", "/spot/innerConeAngle",
                                   "/spot/outerConeAngle"};

bool is_blenders(const tinygltf::Model& model) {
    return model.asset.generator.starts_with("Khronos glTF Blender I/O");
}

// Of a file that kinora-convert made of one of Blender's.
bool was_blenders(const tinygltf::Value& extras) {
    if (!extras.IsObject() || !extras.Has("kinora_blender")) return false;
    const tinygltf::Value& said = extras.Get("kinora_blender");
    return said.IsBool() && said.Get<bool>();
}

// cd/m2 that are 1.0 in the picture. Blender's lights in watts come as hundreds of candela or lux:
// radiance 1 there is 683 cd/m2 here.
double nits_of_one(const tinygltf::Model& model, GltfReport& report) {
    if (!is_blenders(model)) return 1;
    bool watts = std::any_of(model.lights.begin(), model.lights.end(),
                             [](const tinygltf::Light& l) { return l.intensity >= 100; });
    if (watts) report.add(Code::GLTF_LIGHT_WATTS, "/extensions/KHR_lights_punctual/lights");
    return watts ? kLumensPerWatt : 1;
}

}  // namespace

void import_lights(const tinygltf::Model& model, double meter, RslExtras& rsl, UniqueIds& ids,
                   PointerSlots& pointers, GltfReport& report, SceneDescription& out) {
    double scale = 1 / nits_of_one(model, report);
    for (size_t l = 0; l < model.lights.size(); ++l) {
        const tinygltf::Light& from = model.lights[l];
        std::string pointer = fmt::format("/extensions/KHR_lights_punctual/lights/{}", l);
        LightDefinition& to = out.lights.emplace_back();
        to.name = from.name;
        to.id = ids.id(from.name, "light", l);
        to.where = report.location(pointer);
        to.blender = was_blenders(from.extras);
        if (rsl.import_light(from.extras, pointer, to)) {
            for (const char* value : kValues) pointers.pass_over(pointer + value);
            continue;
        }
        to.blender |= is_blenders(model);
        bool known = from.type == "directional" || from.type == "point" || from.type == "spot";
        if (!known) {
            report.add(Code::GLTF_VALUE, pointer + "/type",
                       fmt::format("'{}' is no light; it stays dark", from.type));
        }
        std::string name = known ? from.type : "point";
        to.shader.shader = library_shader("gltf_" + name);
        std::vector<double> color = {1, 1, 1};
        for (size_t k = 0; k < 3 && k < from.color.size(); ++k)
            if (std::isfinite(from.color[k])) color[k] = std::max(from.color[k], 0.0);
        ValueSlot tint = set_number(to.shader, "lightcolor", color, out.values);
        pointers.follow({pointer + "/color", color}, {tint});
        auto one = [&](const char* param, double value) {
            return set_number(to.shader, param, std::span(&value, 1), out.values);
        };
        auto follow = [&](const char* member, ValueSlot slot, double unit) {
            pointers.follow({pointer + member, {out.values[slot.offset]}}, {slot}, unit);
        };
        bool shines = known && std::isfinite(from.intensity) && from.intensity > 0;
        ValueSlot intensity = one("intensity", shines ? from.intensity * scale : 0.0);
        if (known)
            follow("/intensity", intensity, scale);
        else
            pointers.pass_over(pointer + "/intensity");
        if (name == "directional") continue;
        if (meter != 1) one("unit", 1 / meter);
        double range = std::isfinite(from.range) ? std::max(from.range, 0.0) : 0.0;
        follow("/range", one("range", range), 1);
        if (name != "spot") continue;
        double outer = std::clamp(from.spot.outerConeAngle, 1e-4, kPi / 2);
        follow("/spot/outerConeAngle", one("outer_angle", outer), 1);
        double inner = std::clamp(from.spot.innerConeAngle, 0.0, outer);
        follow("/spot/innerConeAngle", one("inner_angle", inner), 1);
    }
}

}  // namespace kinora
