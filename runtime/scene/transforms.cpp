// runtime/scene/transforms.cpp: values to matrices; the node hierarchy.
#include "runtime/scene/transforms.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "runtime/base/transform_matrix.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"

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

dmat4 path_conversion(const SceneNodes& scene, uint32_t node) {
    dmat4 m(1.0);
    for (uint32_t n = node; n != kNone; n = scene.nodes[n].parent)
        m = scene.nodes[n].conversion * m;
    return m;
}

double unit_of(const dmat4& conversion) {
    return std::cbrt(std::abs(glm::determinant(dmat3(conversion))));
}

namespace {

void update_node(const SceneNodes& scene, Pose& pose, uint32_t n) {
    const Node& node = scene.nodes[n];
    NodePose& stands = pose.nodes[n];
    bool own = pose.changed[node.definition / 64] >> (node.definition % 64) & 1;
    bool above = node.parent != kNone && pose.nodes[node.parent].moved;
    stands.moved = pose.first_frame || own || above;
    if (!stands.moved) return;
    dmat4 local =
        node.conversion * node_matrix(scene.description->nodes[node.definition], pose.values);
    dmat4 world = node.parent == kNone ? local : pose.nodes[node.parent].world * local;
    // Never where it stood in the frame before: all zero is singular, and reported as such.
    stands.finite = is_finite(world);
    stands.world = stands.finite ? world : dmat4(0.0);
}

}  // namespace

void update_transforms(const SceneNodes& scene, Pose& pose) {
    if (pose.first_frame) {
        for (uint32_t n = 0; n < scene.nodes.size(); ++n) update_node(scene, pose, n);
        pose.rest_finite = true;
        for (uint32_t n = 0; n < scene.nodes.size(); ++n)
            pose.rest_finite &= scene.nodes[n].can_move || pose.nodes[n].finite;
    } else {
        for (uint32_t n : scene.moving.nodes) update_node(scene, pose, n);
    }
    pose.all_finite = pose.rest_finite && std::ranges::all_of(scene.moving.nodes, [&](uint32_t n) {
                          return pose.nodes[n].finite;
                      });
}

void rest_nodes(Pose& pose) {
    for (NodePose& node : pose.nodes) node.moved = false;
}

void find_moving_parts(SceneNodes& scene, const SceneShapes& placed) {
    MovingParts parts;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].can_move) parts.nodes.push_back(n);
    auto moves = [&](const Shape& shape) {
        return shape.kind == raytrace::GeometryKind::Deforming ||
               (shape.kind == raytrace::GeometryKind::Instanced &&
                scene.nodes[shape.node].can_move);
    };
    for (uint32_t s = 0; s < placed.shapes.size(); ++s)
        if (moves(placed.shapes[s])) parts.shapes.push_back(s);
    for (uint32_t s = 0; s < placed.surfaces.size(); ++s)
        if (moves(placed.shapes[placed.surfaces[s].shape])) parts.surfaces.push_back(s);
    scene.moving = std::move(parts);
}

mat3 normal_matrix(const dmat4& m, bool mirrored) {
    dmat3 l(m);
    dmat3 cofactor(glm::cross(l[1], l[2]), glm::cross(l[2], l[0]), glm::cross(l[0], l[1]));
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(cofactor[c][r]));
    if (largest > 0 && std::isfinite(largest)) cofactor /= largest;
    return mat3(mirrored ? -cofactor : cofactor);
}

}  // namespace kinora
