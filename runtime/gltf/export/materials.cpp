// runtime/gltf/export/materials.cpp: materials of primitives.
#include "runtime/gltf/export/materials.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kinora {

uint32_t MaterialWriter::write(const MeshUse& use, const PrimitiveGroup& group) {
    GltfLook look = looks_.look_of(use, group);
    const MaterialDefinition& definition = look.definition;
    const ShaderUse* top = definition.surfaces.empty() ? nullptr : &definition.surfaces.back();
    Json result = Json::object();
    const char* extras = "its RSL shaders";
    bool is_all = false;  // what is not in extras
    if (look.is_gltf) {
        result = surfaces_.pbr(*top, look.bound, group, is_all);
        extras = "its shader's parameters (pbrMetallicRoughness comes near them)";
    } else if (top && is_common_surface(*top)) {
        result = surfaces_.common(definition, *top, look.bound, group);
        extras = "its shading model (pbrMetallicRoughness comes near it)";
    } else {
        result["pbrMetallicRoughness"] = {{"metallicFactor", 0},
                                          {"baseColorFactor", {0.8, 0.8, 0.8, 1}}};
    }
    if (!definition.id.empty()) result["name"] = definition.id;
    bool double_sided = !definition.hide_backfaces && !group.one_sided &&
                        description_.meshes[use.mesh].double_sided;
    if (double_sided) result["doubleSided"] = true;
    Json shaders = rsl_.material(look, group);
    bool has_extras = !shaders.empty() && !(is_all && shaders.size() == 1);
    if (has_extras) result["extras"]["kinora_rsl"] = shaders;
    auto [found, fresh] = materials_.try_emplace(text_of(result), uint32_t(materials_.size()));
    if (fresh) {
        document_.add("materials", std::move(result));
        if (!look.is_plain) report_losses(definition, has_extras ? extras : "");
    }
    return found->second;
}

void MaterialWriter::report_losses(const MaterialDefinition& definition, const char* extras) {
    if (!reported_.insert(&definition).second) return;
    std::string name = fmt::format("material '{}'", definition.id);
    Location where;
    bool moves = false;
    auto look = [&](const std::vector<ShaderUse>& uses) {
        for (const ShaderUse& use : uses)
            for (const ParamSource& p : use.params) {
                if (where.file == kNoFile) where = p.where;
                moves |= is_animated(description_, p.value);
            }
    };
    look(definition.surfaces);
    look(definition.displacements);
    look(definition.transformations);
    if (moves) losses_.lost(name, "its animated parameters", where);
    if (*extras) losses_.in_extras(name, extras, where);
}

}  // namespace kinora
