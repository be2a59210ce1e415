// runtime/scene/transforms.cpp: values to matrices; the node hierarchy.
#include "runtime/scene/transforms.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "runtime/base/transform_matrix.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

using MatrixOf = dmat4 (*)(const double*);
constexpr MatrixOf kMatrixOf[] = {translation_matrix, rotation_matrix, scale_matrix,
                                  rows_matrix,        lookat_matrix,   skew_matrix,
                                  quaternion_matrix};  // TransformKind

}  // namespace

dmat4 transform_matrix(TransformKind kind, const double* v) {
    return kMatrixOf[size_t(kind)](v);
}

dmat4 node_matrix(const NodeDefinition& node, std::span<const double> values) {
    dmat4 m(1.0);
    for (const Transform& t : node.transforms)
        m = m * transform_matrix(t.kind, values.data() + t.value);
    return m;
}

bool is_finite(const dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

dmat4 path_conversion(const Scene& scene, uint32_t node) {
    dmat4 m(1.0);
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent)
        m = scene.nodes[n].conversion * m;
    return m;
}

double unit_of(const dmat4& conversion) {
    return std::cbrt(std::abs(glm::determinant(dmat3(conversion))));
}

namespace {

void update_node(Scene& scene, Node& node) {
    bool own = scene.changed[node.definition / 64] >> (node.definition % 64) & 1;
    bool above = node.parent != kNone && scene.nodes[node.parent].moved;
    node.moved = scene.first_frame || own || above;
    scene.all_finite &= node.finite || node.moved;
    if (!node.moved) return;
    dmat4 local =
        node.conversion * node_matrix(scene.description->nodes[node.definition], scene.values);
    dmat4 world = node.parent == kNone ? local : scene.nodes[node.parent].world * local;
    // Never where it stood in the frame before: all zero is singular, and reported as such.
    node.finite = is_finite(world);
    node.world = node.finite ? world : dmat4(0.0);
    scene.all_finite &= node.finite;
}

}  // namespace

void update_transforms(Scene& scene) {
    scene.all_finite = scene.first_frame || scene.moving.rest_finite;
    if (scene.first_frame)
        for (Node& node : scene.nodes) update_node(scene, node);
    else
        for (uint32_t n : scene.moving.nodes) update_node(scene, scene.nodes[n]);
}

void find_moving_parts(Scene& scene) {
    MovingParts parts;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        Node& node = scene.nodes[n];
        node.moved = false;
        if (node.can_move)
            parts.nodes.push_back(n);
        else
            parts.rest_finite &= node.finite;
    }
    auto moves = [&](const Shape& shape) {
        return shape.kind == raytrace::GeometryKind::Deforming ||
               (shape.kind == raytrace::GeometryKind::Instanced &&
                scene.nodes[shape.node].can_move);
    };
    for (uint32_t s = 0; s < scene.shapes.size(); ++s)
        if (moves(scene.shapes[s])) parts.shapes.push_back(s);
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        if (moves(scene.shapes[scene.surfaces[s].shape])) parts.surfaces.push_back(s);
    scene.moving = std::move(parts);
}

}  // namespace kinora
