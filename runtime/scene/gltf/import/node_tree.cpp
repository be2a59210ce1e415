// runtime/scene/gltf/import/node_tree.cpp: the nodes that a scene reaches, as trees.
#include "runtime/scene/gltf/import/node_tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

constexpr size_t kMaxNodeDepth = 1024;  // the builder recurses into children

std::vector<int> root_nodes(const tinygltf::Model& model, GltfReport& report) {
    if (!model.scenes.empty()) {
        std::vector<int> roots = model.scenes[shown_scene(model)].nodes;
        for (int& root : roots)
            if (!has_index(root, model.nodes.size())) root = -1;  // the others keep their positions
        return roots;
    }
    report.add(Code::GLTF_NO_SCENE, "");
    std::vector<bool> child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (int c : node.children)
            if (has_index(c, child.size())) child[size_t(c)] = true;
    std::vector<int> roots;
    for (size_t n = 0; n < child.size(); ++n)
        if (!child[n]) roots.push_back(int(n));
    return roots;
}

}  // namespace

size_t shown_scene(const tinygltf::Model& model) {
    return has_index(model.defaultScene, model.scenes.size()) ? size_t(model.defaultScene) : 0;
}

// Walks the scene's trees; a node met again (a second parent, a cycle) is not entered again, so
// what remains are trees.
GltfNodeTree read_node_tree(const tinygltf::Model& model, GltfReport& report) {
    GltfNodeTree tree;
    tree.roots = root_nodes(model, report);
    tree.shown.assign(model.nodes.size(), false);
    tree.children.resize(model.nodes.size());
    struct Step {
        int node, parent;
        size_t depth, index;  // index: among its parent's children, or the scene's nodes
    };
    std::vector<Step> stack;
    for (size_t r = tree.roots.size(); r-- > 0;) stack.push_back({tree.roots[r], -1, 1, r});
    while (!stack.empty()) {
        Step step = stack.back();
        stack.pop_back();
        std::string pointer =
            step.parent < 0 ? fmt::format("/scenes/{}/nodes/{}", shown_scene(model), step.index)
                            : fmt::format("/nodes/{}/children/{}", step.parent, step.index);
        if (!has_index(step.node, model.nodes.size())) continue;
        uint32_t node = uint32_t(step.node);
        if (tree.shown[node]) {
            report.add(Code::GLTF_NODE, pointer, step.node,
                       "it is met twice; here it is left out (each has one parent, no cycles)");
            continue;
        }
        if (step.depth > kMaxNodeDepth) {
            report.add(Code::GLTF_LIMIT, pointer,
                       fmt::format("nodes are nested more than {} deep", kMaxNodeDepth));
            continue;
        }
        tree.shown[node] = true;
        if (step.parent >= 0) tree.children[size_t(step.parent)].push_back(node);
        const std::vector<int>& children = model.nodes[node].children;
        for (size_t c = children.size(); c-- > 0;)
            stack.push_back({children[c], step.node, step.depth + 1, c});
    }
    return tree;
}

}  // namespace kinora
