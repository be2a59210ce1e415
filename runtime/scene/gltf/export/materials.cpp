// runtime/scene/gltf/export/materials.cpp: materials of primitives.
#include "runtime/scene/gltf/export/materials.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kinora {

// What glTF's viewers show of a look.
Json MaterialWriter::surface_at(const GltfLook& look, const PrimitiveGroup& group,
                                const std::vector<double>& values, Surface& surface) {
    const MaterialDefinition& definition = look.definition;
    const ShaderUse* top = definition.surfaces.empty() ? nullptr : &definition.surfaces.back();
    if (look.is_gltf) {
        surface.extras = "its shader's parameters (pbrMetallicRoughness comes near them)";
        return surfaces_.pbr({*top, values}, look.bound, group, surface.is_all);
    }
    surface.is_all = false;
    if (top && is_common_surface(*top)) {
        surface.extras = "its shading model (pbrMetallicRoughness comes near it)";
        return surfaces_.common(definition, {*top, values}, look.bound, group);
    }
    surface.extras = "its RSL shaders";
    return {
        {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.8, 0.8, 0.8, 1}}}}};
}

uint32_t MaterialWriter::write(const MeshUse& use, const PrimitiveGroup& group) {
    GltfLook look = looks_.look_of(use, group);
    const MaterialDefinition& definition = look.definition;
    std::vector<ValueSlot> slots;
    if (!definition.surfaces.empty()) slots = slots_of(definition.surfaces.back());
    Surface surface{"", true};
    ObjectAt surface_of = [&](const std::vector<double>& values) {
        return surface_at(look, group, values, surface);
    };
    MovingObject moving = motion_.object(slots, surface_of);
    Json result = moving.rest();
    if (!definition.id.empty()) result["name"] = definition.id;
    bool double_sided = !definition.hide_backfaces && !group.one_sided &&
                        description_.meshes[use.mesh].double_sided;
    if (double_sided) result["doubleSided"] = true;
    Json shaders = rsl_.material(look, group);
    bool has_extras = !shaders.empty() && !(surface.is_all && shaders.size() == 1);
    if (has_extras) result["extras"]["kinora_rsl"] = shaders;
    auto [found, fresh] =
        materials_.try_emplace(text_of(result) + moving_key(look), uint32_t(materials_.size()));
    if (!fresh) return found->second;
    document_.add("materials", std::move(result));
    std::string pointer = fmt::format("/materials/{}", found->second);
    motion_.move_object(pointer, slots, surface_of, moving);
    if (has_extras) rsl_.move_material(pointer + "/extras/kinora_rsl", look);
    if (!look.is_plain && has_extras) report_extras(definition, surface.extras);
    return found->second;
}

// Looks that are equal at rest are two where other channels move them.
std::string MaterialWriter::moving_key(const GltfLook& look) const {
    std::string key;
    auto add = [&](ValueSlot slot) {
        if (motion_.is_moved(slot)) key += fmt::format(" {}", slot.offset);
    };
    const MaterialDefinition& m = look.definition;
    for (const auto* uses :
         {&m.surfaces, &m.displacements, &m.transformations, &m.interior, &m.exterior, &m.lights})
        for (const ShaderUse& use : *uses)
            for (ValueSlot slot : slots_of(use)) add(slot);
    for (const auto& [name, slot] : look.bound.params) add(slot);
    return key;
}

void MaterialWriter::report_extras(const MaterialDefinition& definition, const char* extras) {
    if (!reported_.insert(&definition).second) return;
    Location where;
    for (const auto* uses :
         {&definition.surfaces, &definition.displacements, &definition.transformations})
        for (const ShaderUse& use : *uses)
            for (const ParamSource& p : use.params)
                if (where.file == kNoFile) where = p.where;
    losses_.in_extras(fmt::format("material '{}'", definition.id), extras, where);
}

}  // namespace kinora
