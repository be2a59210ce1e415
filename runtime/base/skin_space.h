// runtime/base/skin_space.h: where a COLLADA skin stands: in world space, or at the node that
// instances it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/base/math.h"

namespace kinora {

enum class SkinSpace : uint8_t {
    World,      // as the specification has it: the node's matrix plays no part
    BindsNode,  // the node's matrix is the bind_shape_matrix that the file left out
    Node,       // the node's matrix is applied to the skinned result
    NodeBelow,  // so is what it has below the ancestor that it shares with the joints
};

struct RestJoint {
    dmat4 world;  // of the joint's node, by the file's own values
    dmat4 inverse_bind;
};

// A bind_shape_matrix, or a node that stands at the origin, leaves nothing to ask. Otherwise the
// joints at rest tell: they move the mesh to the node (World), nowhere (BindsNode: what is applied
// first is right in every pose), or elsewhere (Node; what moves the joints as well is not applied
// twice: NodeBelow). `node` is the node's world matrix, `shared` that of shared_ancestor.
SkinSpace skin_space(const dmat4& bind_shape, const dmat4& node, const dmat4& shared,
                     std::span<const RestJoint> joints);

// How many of the joints turn what they move inside out at rest.
size_t mirroring_joints(const dmat4& bind_shape, std::span<const RestJoint> joints);

// The nearest node that `node` and all `joints` are or stand below; `none` where there is none.
// `parent_of` gives smaller numbers, in the end `none`, which is greater than all.
template <class ParentOf>
uint32_t shared_ancestor(uint32_t node, std::span<const uint32_t> joints, uint32_t none,
                         ParentOf parent_of) {
    uint32_t shared = node;
    for (uint32_t joint : joints) {
        if (joint == none) continue;
        uint32_t above = joint;
        while (above != none && shared != none && above != shared)
            (above > shared ? above : shared) = parent_of(above > shared ? above : shared);
        if (above == none) return none;
    }
    return shared;
}

}  // namespace kinora
