// runtime/scene/gltf/export/nodes.h: matrices and stacks of transforms as glTF nodes.
#pragma once

#include <cstdint>

#include "runtime/scene/gltf/curves/node_motion.h"
#include "runtime/scene/gltf/document/document.h"
#include "runtime/scene/gltf/document/loss_report.h"

namespace kinora {

// Each returns the node that children hang on.
class NodeWriter {
  public:
    NodeWriter(const SceneDescription& description, NodeMotion& motion, GltfDocument& document,
               LossReport& losses)
        : description_(description), motion_(motion), document_(document), losses_(losses) {}

    // A matrix that stands still.
    uint32_t write_still(const dmat4& matrix, uint32_t parent);

    // The stack of a definition after `conversion`: one node where it is translation, rotation and
    // scale at all times; else one a transform, those that stand still together.
    uint32_t write_stack(const NodeDefinition& definition, const dmat4& conversion,
                         uint32_t parent);

  private:
    uint32_t write_apart(const NodeDefinition& definition, const dmat4& conversion,
                         uint32_t parent);

    const SceneDescription& description_;
    NodeMotion& motion_;
    GltfDocument& document_;
    LossReport& losses_;
};

}  // namespace kinora
