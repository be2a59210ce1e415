// runtime/scene/build/instances/vertex_instances.cpp: shader instances that move vertices.
#include "runtime/scene/build/instances/vertex_instances.h"

#include "runtime/scene/build/instances/vertex_inputs.h"
#include "runtime/scene/description/displacements.h"

namespace kinora {

void VertexInstances::add(ShaderInstanceKind kind, Surface& surface, const MaterialUse* use,
                          const MaterialDefinition& material) {
    bool displacement = kind == ShaderInstanceKind::Displacement;
    std::vector<ShaderUse> layers =
        displacement ? displacements_of(material) : material.transformations;
    if (layers.empty()) return;
    const Shape& shape = shapes_.shapes[surface.shape];
    const PrimitiveGroup& group = *shapes_.meshes[shape.mesh].groups[surface.group].definition;
    KeyedInstance made = begin_instance(description_, kind, material, layers, use, shape.node);
    VertexInputs inputs = find_vertex_inputs(group, use, made.instance->layers);
    surface.st = inputs.st;
    made.instance->varying = std::move(inputs.varying);
    made.key += varying_key(*made.instance);
    VertexUse& result = displacement ? surface.displacement : surface.transformation;
    result.varying = std::move(inputs.attributes);
    result.instance = find_or_compile(std::move(made));
}

uint32_t VertexInstances::find_or_compile(KeyedInstance made) {
    auto [entry, is_new] = by_key_.try_emplace(made.key, uint32_t(scene_.vertex_instances.size()));
    if (!is_new) return entry->second;
    ShaderInstance& instance = *made.instance;
    instance.index = entry->second;
    bool compiled = compiler_.compile(instance);
    all_compiled_ &= compiled;
    // A displacement that failed is kept too: its errors have been reported.
    bool displacement = instance.kind == ShaderInstanceKind::Displacement;
    if (compiled && displacement && !instance.lowered.moves_P)
        entry->second = kNone;
    else
        scene_.vertex_instances.push_back(std::move(made.instance));
    return entry->second;
}

}  // namespace kinora
