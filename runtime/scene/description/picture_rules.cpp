// runtime/scene/description/picture_rules.cpp: what the picture shows of a description.
#include "runtime/scene/description/picture_rules.h"

namespace kinora {

bool shows_a_mesh(const SceneDescription& description) {
    std::vector<bool> seen(description.nodes.size(), false);
    std::vector<uint32_t> waiting;
    for (const ChildUse& root : description.roots) waiting.push_back(root.node);
    while (!waiting.empty()) {
        uint32_t n = waiting.back();
        waiting.pop_back();
        const NodeDefinition& node = description.nodes[n];
        if (seen[n] || hides(node)) continue;
        seen[n] = true;
        if (!node.meshes.empty()) return true;
        for (const ChildUse& child : node.children) waiting.push_back(child.node);
    }
    return false;
}

const VertexAttribute* find_attribute(const PrimitiveGroup& group, std::string_view semantic,
                                      uint32_t set) {
    const VertexAttribute* best = nullptr;
    for (const VertexAttribute& a : group.attributes) {
        if (a.semantic != semantic || (set != kNone && a.set != set)) continue;
        if (!best || a.set < best->set) best = &a;
    }
    return best;
}

const VertexAttribute* normals_of(const PrimitiveGroup& group) {
    const VertexAttribute* found = find_attribute(group, "NORMAL");
    return found && found->stride >= 3 ? found : nullptr;
}

const VertexBinding* find_binding(const MaterialUse* use, std::string_view name) {
    if (use)
        for (const VertexBinding& binding : use->vertex_bindings)
            if (binding.param == name) return &binding;
    return nullptr;
}

const VertexAttribute* texture_coordinates(const PrimitiveGroup& group, const MaterialUse* use,
                                           std::string_view texcoord) {
    const VertexBinding* binding = find_binding(use, texcoord);
    const VertexAttribute* bound =
        binding ? find_attribute(group, binding->semantic, binding->set) : nullptr;
    return bound ? bound : find_attribute(group, "TEXCOORD");
}

}  // namespace kinora
