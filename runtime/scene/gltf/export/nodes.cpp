// runtime/scene/gltf/export/nodes.cpp: matrices and stacks of transforms as glTF nodes.
#include "runtime/scene/gltf/export/nodes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/curves/trs.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

Json numbers(const dvec3& v) {
    return {v.x, v.y, v.z};
}

Json trs_node(const Trs& trs) {
    Json node = Json::object();
    if (trs.translation != dvec3(0.0)) node["translation"] = numbers(trs.translation);
    if (trs.rotation != std::array<double, 4>{0, 0, 0, 1}) node["rotation"] = trs.rotation;
    if (trs.scale != dvec3(1.0)) node["scale"] = numbers(trs.scale);
    return node;
}

}  // namespace

uint32_t NodeWriter::write_still(const dmat4& matrix, uint32_t parent) {
    Trs trs, inner;
    if (!is_finite(matrix)) {
        losses_.lost("a node", "a matrix that is not finite");
        return document_.add_node(Json::object(), parent);
    }
    if (decompose_trs(matrix, trs)) return document_.add_node(trs_node(trs), parent);
    trs = Trs();
    split_shear(matrix, trs, inner);
    uint32_t outer = document_.add_node(trs_node(trs), parent);
    return document_.add_node(trs_node(inner), outer);
}

uint32_t NodeWriter::write_stack(const NodeDefinition& definition, const dmat4& conversion,
                                 uint32_t parent) {
    std::span<const Transform> stack = definition.transforms;
    if (!motion_.is_moved(stack))
        return write_still(conversion * node_matrix(definition, description_.values), parent);
    if (!motion_.is_always_trs(conversion, stack))
        return write_apart(definition, conversion, parent);
    dmat4 matrix = stack_matrix(conversion, stack, description_.values);
    uint32_t node = write_still(matrix, parent);
    motion_.move_node(node, stack, conversion);
    return node;
}

// One node for each transform that moves, and one for those between that stand still.
uint32_t NodeWriter::write_apart(const NodeDefinition& definition, const dmat4& conversion,
                                 uint32_t parent) {
    dmat4 still = conversion;
    uint32_t node = parent;
    for (const Transform& transform : definition.transforms) {
        std::span<const Transform> own(&transform, 1);
        dmat4 matrix = stack_matrix(dmat4(1.0), own, description_.values);
        if (!motion_.is_moved(own)) {
            still = still * matrix;
            continue;
        }
        if (!is_identity(still, 1e-15)) node = write_still(still, node);
        still = dmat4(1.0);
        if (!motion_.is_always_trs(dmat4(1.0), own))
            losses_.lost(fmt::format("node '{}'", definition.id), "animated shear");
        Trs trs;
        decompose_trs(matrix, trs);
        node = document_.add_node(trs_node(trs), node);
        motion_.move_node(node, own, dmat4(1.0));
    }
    return is_identity(still, 1e-15) ? node : write_still(still, node);
}

}  // namespace kinora
