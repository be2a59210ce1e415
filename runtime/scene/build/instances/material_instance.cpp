// runtime/scene/build/instances/material_instance.cpp: a material's shaders as a shader instance.
#include "runtime/scene/build/instances/material_instance.h"

#include <fmt/format.h>

namespace kinora {

namespace {

bool is_node_matrix(const SceneDescription& description, uint32_t value) {
    for (const NodeDefinition& node : description.nodes)
        for (const Transform& t : node.transforms)
            if (t.value == value) return t.kind == TransformKind::Matrix;
    return false;
}

// A parameter given in shader space, so that the result depends on the node.
bool has_spatial_param(const ShaderUse& use) {
    for (const ParamSource& source : use.params)
        for (const rsl::ShaderParameter& p : use.shader->parameters)
            if (source.name == p.name && rsl::is_spatial(p.type.base) && source.value.count >= 3)
                return true;
    return false;
}

}  // namespace

void apply_binds(const SceneDescription& description, const MaterialUse* use,
                 std::vector<ShaderUse>& layers, std::string& key) {
    if (!use) return;
    for (const auto& [name, slot] : use->params) {
        key += fmt::format("|{}={}+{}", name, slot.offset, slot.count);
        bool matrix = slot.count == 16 && is_node_matrix(description, slot.offset);
        for (ShaderUse& layer : layers) {
            std::erase_if(layer.params, [&](const ParamSource& s) { return s.name == name; });
            ParamSource source;
            source.name = name;
            source.value = slot;
            source.by_columns = matrix;
            layer.params.push_back(std::move(source));
        }
    }
}

KeyedInstance begin_instance(const SceneDescription& description, ShaderInstanceKind kind,
                             const MaterialDefinition& material, std::vector<ShaderUse> layers,
                             const MaterialUse* use, uint32_t node) {
    auto instance = std::make_unique<ShaderInstance>();
    instance->kind = kind;
    instance->name = material.id.empty() ? material.name : material.id;
    instance->hide_backfaces = material.hide_backfaces;
    instance->layers = std::move(layers);
    std::string key = fmt::format("{} {}", int(kind), static_cast<const void*>(&material));
    apply_binds(description, use, instance->layers, key);
    for (const ShaderUse& layer : instance->layers)
        if (layer.space.empty() && has_spatial_param(layer)) instance->node = node;
    if (instance->node != kNone) key += fmt::format("|node {}", instance->node);
    return {std::move(instance), std::move(key)};
}

std::string varying_key(const ShaderInstance& instance) {
    std::string key;
    for (const VaryingParam& v : instance.varying)
        key += fmt::format("|{}:{}={}", v.layer, v.name, v.semantic == "Pref");
    return key;
}

}  // namespace kinora
