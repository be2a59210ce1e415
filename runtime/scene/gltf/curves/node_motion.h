// runtime/scene/gltf/curves/node_motion.h: stacks of transforms and weights as curves of glTF
// nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/gltf/curves/curve_writer.h"

namespace kinora {

class NodeMotion {
  public:
    NodeMotion(const SceneDescription& description, std::span<const Take> takes,
               CurveWriter& curves);

    // By any take.
    bool is_moved(std::span<const Transform> stack) const;

    // Whether before * stack is translation, rotation and scale at rest, at all keys and between
    // them.
    bool is_always_trs(const dmat4& before, std::span<const Transform> stack);

    // Every take's curves of a node whose matrix is before * stack.
    void move_node(uint32_t node, std::span<const Transform> stack, const dmat4& before);
    void move_weights(uint32_t node, uint32_t morph);

  private:
    void move_node(uint32_t take, uint32_t node, std::span<const Transform> stack,
                   const dmat4& before);
    const Transform* only_mover(uint32_t take, std::span<const Transform> stack,
                                TransformKind kind) const;

    const SceneDescription& description_;
    std::span<const Take> takes_;
    CurveWriter& curves_;
    ValuesAtTime values_;
};

}  // namespace kinora
