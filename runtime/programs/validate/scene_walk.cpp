// runtime/programs/validate/scene_walk.cpp: the unrolled tree with rest matrices.
#include "runtime/programs/validate/scene_walk.h"

#include <array>

#include "runtime/base/transform_matrix.h"

namespace kinora {

namespace {

using MatrixOf = dmat4 (*)(const double*);
constexpr MatrixOf kMatrixOf[] = {translation_matrix, rotation_matrix, scale_matrix, rows_matrix,
                                  lookat_matrix,      skew_matrix};  // collada::TransformKind

dmat4 transform_matrix(const collada::Transform& transform) {
    std::array<double, 16> v = transform.slot.values;
    if (transform.kind == collada::TransformKind::Matrix)  // slots are column-major
        for (size_t row = 0; row < 4; ++row)
            for (size_t column = 0; column < 4; ++column)
                v[row * 4 + column] = transform.slot.values[column * 4 + row];
    return kMatrixOf[size_t(transform.kind)](v.data());
}

}  // namespace

dmat4 rest_matrix(const collada::Node& node) {
    dmat4 m(1.0);
    for (const collada::Transform& transform : node.transforms) m = m * transform_matrix(transform);
    return m;
}

std::vector<PlacedNode> placed_nodes(const collada::SceneData& scene) {
    std::vector<PlacedNode> placed;
    struct Step {
        uint32_t node;
        dmat4 above;
    };
    std::vector<Step> open;
    auto change = [&](uint32_t conversion) {
        return conversion == collada::kNone ? dmat4(1.0) : scene.conversions[conversion];
    };
    for (auto root = scene.roots.rbegin(); root != scene.roots.rend(); ++root)
        if (*root != collada::kNone) open.push_back({*root, change(scene.nodes[*root].conversion)});
    while (!open.empty()) {
        Step step = open.back();
        open.pop_back();
        const collada::Node& node = scene.nodes[step.node];
        dmat4 world = step.above * rest_matrix(node);
        placed.push_back({step.node, world});
        for (auto instance = node.instances.rbegin(); instance != node.instances.rend(); ++instance)
            open.push_back({instance->node, world * change(instance->conversion)});
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, world * change(scene.nodes[*child].conversion)});
    }
    return placed;
}

}  // namespace kinora
