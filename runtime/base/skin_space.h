// runtime/base/skin_space.h: where a COLLADA skin stands: in world space, or at the node that
// instances it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

// Node and joints at one time. `node` is the world matrix of the node that instances the skin,
// `shared` that of shared_ancestor (the identity where there is none).
struct SkinPose {
    dmat4 node{1.0}, shared{1.0};
    std::vector<RestJoint> joints;
};

struct SkinPlacement {
    SkinSpace space = SkinSpace::World;
    dmat4 bind{1.0};  // BindsNode: the bind_shape_matrix
};

// A bind_shape_matrix, or a node that stands at the origin, leaves nothing to ask. Otherwise the
// joints tell: they move the mesh to the node (World), nowhere (BindsNode: what is applied first is
// right in every pose), or elsewhere (Node; what moves the joints as well is not applied twice:
// NodeBelow). They are asked as the file leaves them (`rest`); where that is no pose of the bind,
// at the first keys (`start`), since some exporters leave nodes as the last frame had them.
SkinPlacement skin_placement(const dmat4& bind_shape, const SkinPose& rest, const SkinPose& start);

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
