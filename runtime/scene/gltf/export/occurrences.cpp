// runtime/scene/gltf/export/occurrences.cpp: the unrolled tree of nodes.
#include "runtime/scene/gltf/export/occurrences.h"

#include <nlohmann/json.hpp>

#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

std::vector<double> values_at_start(const SceneDescription& description) {
    std::vector<double> values = description.values;
    const anim::Animation& animation = description.animation;
    std::vector<uint64_t> changed(anim::changed_words(animation.owner_count));
    anim::evaluate(animation, anim::time_range(animation).begin, values, changed);
    return values;
}

void write_name(const NodeDefinition& definition, Json& node) {
    const std::string& name = !definition.name.empty() ? definition.name : definition.id;
    if (!name.empty()) node["name"] = name;
    Json attributes = Json::object();
    for (const UserAttribute& a : definition.attributes) {
        if (a.numbers.empty())
            attributes[a.name] = a.text;
        else
            attributes[a.name] = a.numbers;
    }
    if (!attributes.empty()) node["extras"]["kinora_attributes"] = attributes;
}

}  // namespace

Occurrences::Occurrences(const SceneDescription& description, uint32_t root, NodeWriter& nodes,
                         GltfDocument& document)
    : description_(description),
      root_(root),
      nodes_(nodes),
      document_(document),
      start_values_(values_at_start(description)) {
    for (const ChildUse& top : description.roots) unroll(top.node, kNone, top.conversion);
}

void Occurrences::unroll(uint32_t index, uint32_t parent, const dmat4& conversion) {
    const NodeDefinition& definition = description_.nodes[index];
    uint32_t above = parent == kNone ? root_ : all_[parent].node;
    uint32_t node = nodes_.write_stack(definition, conversion, above);
    write_name(definition, document_.node(node));
    uint32_t own = uint32_t(all_.size());
    dmat4 world = conversion * node_matrix(definition, description_.values);
    dmat4 start = conversion * node_matrix(definition, start_values_);
    if (parent != kNone) world = all_[parent].world * world;
    if (parent != kNone) start = all_[parent].start * start;
    bool hidden = hides(definition) || (parent != kNone && all_[parent].hidden);
    if (hides(definition)) document_.hide(node);
    all_.push_back({index, parent, node, world, start, conversion, hidden});
    for (const ChildUse& child : definition.children) unroll(child.node, own, child.conversion);
}

uint32_t Occurrences::nearest(uint32_t definition, uint32_t from) const {
    uint32_t best = kNone, best_shared = 0;
    for (uint32_t p = 0; p < all_.size(); ++p) {
        if (all_[p].definition != definition) continue;
        uint32_t shared = 0;
        for (uint32_t x = p; x != kNone && !shared; x = all_[x].parent)
            for (uint32_t y = from; y != kNone && !shared; y = all_[y].parent)
                if (x == y) shared = x + 1;
        if (best == kNone || shared > best_shared) best = p, best_shared = shared;
    }
    return best;
}

}  // namespace kinora
