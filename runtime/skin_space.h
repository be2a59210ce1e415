// runtime/skin_space.h: where a COLLADA skin stands: in world space, or at the node that instances it.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/base/math.h"

namespace kinora {

enum class SkinSpace : uint8_t {
    World,      // as the specification has it: the node's matrix plays no part
    BindsNode,  // the node's matrix is the bind_shape_matrix that the file left out
    Node,       // the node's matrix is applied to the skinned result
};

struct RestJoint {
    dmat4 world;  // of the joint's node, by the file's own values
    dmat4 inverse_bind;
};

// A bind_shape_matrix, or a node that stands at the origin, leaves nothing to ask. Otherwise the
// joints at rest tell: they move the mesh to the node (World), nowhere (BindsNode: what is applied
// first is right in every pose), or elsewhere (Node). `node` is the node's world matrix.
SkinSpace skin_space(const dmat4& bind_shape, const dmat4& node,
                     std::span<const RestJoint> joints);

}  // namespace kinora
