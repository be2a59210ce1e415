// runtime/scene/build/shapes/node_tree.cpp: node definitions unrolled into the nodes of a scene.
#include "runtime/scene/build/shapes/node_tree.h"

#include <algorithm>

#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

std::vector<bool> find_moving(const SceneDescription& description) {
    std::vector<bool> result;
    for (const NodeDefinition& node : description.nodes) {
        bool moves = false;
        for (const Transform& t : node.transforms)
            for (uint32_t i = 0; i < 16 && t.value + i < description.animated.size(); ++i)
                moves |= description.animated[t.value + i];
        result.push_back(moves);
    }
    return result;
}

}  // namespace

uint32_t add_node(SceneNodes& scene, Pose& start, NodeDefinition definition, uint32_t parent) {
    SceneDescription& description = *scene.description;
    take_added_values(description, start);
    uint32_t index = uint32_t(description.nodes.size());
    // Node bits come first among the owners: those behind move up by one word-safe step.
    for (anim::Channel& channel : description.animation.channels)
        if (channel.owner >= index) ++channel.owner;
    ++description.animation.owner_count;
    start.changed.resize(anim::changed_words(description.animation.owner_count), 0);
    Node node;
    node.definition = index;
    node.parent = parent;
    node.chosen = !description.only_chosen;
    NodePose stands{.world = node_matrix(definition, start.values)};
    if (parent != kNone) {
        const Node& above = scene.nodes[parent];
        node.can_move = above.can_move;
        node.hidden = above.hidden;
        node.chosen = above.chosen;
        stands.world = start.nodes[parent].world * stands.world;
    }
    description.nodes.push_back(std::move(definition));
    scene.nodes.push_back(node);
    start.nodes.push_back(stands);
    return uint32_t(scene.nodes.size() - 1);
}

NodeTree::NodeTree(SceneNodes& scene, Pose& start)
    : scene_(scene), start_(start), definition_moves_(find_moving(*scene.description)) {
    for (const ChildUse& root : scene.description->roots) unroll(root.node, kNone, root.conversion);
}

const NodeDefinition& NodeTree::definition(uint32_t node) const {
    return scene_.description->nodes[scene_.nodes[node].definition];
}

void NodeTree::unroll(uint32_t definition, uint32_t parent, const dmat4& conversion) {
    const Node* above = parent == kNone ? nullptr : &scene_.nodes[parent];
    const SceneDescription& description = *scene_.description;
    const NodeDefinition& from = description.nodes[definition];
    Node node;
    node.definition = definition;
    node.parent = parent;
    node.conversion = conversion;
    node.can_move = definition_moves_[definition] || (above && above->can_move);
    node.hidden = hides(from) || (above && above->hidden);
    node.chosen = from.chosen || (above ? above->chosen : !description.only_chosen);
    uint32_t index = uint32_t(scene_.nodes.size());
    scene_.nodes.push_back(node);
    start_.nodes.emplace_back();
    first_occurrence_.try_emplace(definition, index);
    for (const ChildUse& child : from.children) unroll(child.node, index, child.conversion);
}

uint32_t NodeTree::add(NodeDefinition definition, uint32_t parent) {
    uint32_t node = add_node(scene_, start_, std::move(definition), parent);
    definition_moves_.push_back(false);
    first_occurrence_.try_emplace(scene_.nodes[node].definition, node);
    evaluate_anew(scene_, start_, scene_.options.start_time);
    return node;
}

uint32_t NodeTree::nearest_occurrence(uint32_t definition, uint32_t from) const {
    if (definition == kNone) return kNone;
    auto found = first_occurrence_.find(definition);
    if (found == first_occurrence_.end()) return kNone;
    auto depth_shared = [&](uint32_t a) {
        uint32_t best = 0;
        for (uint32_t x = a; x != kNone; x = parent(x))
            for (uint32_t y = from; y != kNone; y = parent(y))
                if (x == y) return std::max(best, x + 1);
        return best;
    };
    uint32_t best = found->second, best_shared = depth_shared(best);
    for (uint32_t n = best + 1; n < scene_.nodes.size(); ++n) {
        if (scene_.nodes[n].definition != definition) continue;
        uint32_t shared = depth_shared(n);
        if (shared > best_shared) {
            best = n;
            best_shared = shared;
        }
    }
    return best;
}

uint32_t NodeTree::named(uint32_t node) const {
    while (definition(node).reference) node = parent(node);
    return node;
}

}  // namespace kinora
