// runtime/scene/build/instances/vertex_inputs.h: vertex inputs for the varying parameters of
// shaders.
#pragma once

#include <vector>

#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

// Varying parameters of the instance that the group has attributes for, the attributes in the same
// order, and the one that s and t are (null: the group has no texture coordinates).
struct VertexInputs {
    std::vector<VaryingParam> varying;
    std::vector<const VertexAttribute*> attributes;
    const VertexAttribute* st = nullptr;
};
VertexInputs find_vertex_inputs(const PrimitiveGroup& group, const MaterialUse* use,
                                std::span<const ShaderUse> layers);

// Displacements have run on the vertices: what the first `done_layers` left in their output
// parameters is an input, for displacement("name"). The attributes are null until the mesh is
// diced.
void add_displaced_inputs(std::span<const ShaderUse> layers, uint32_t done_layers,
                          VertexInputs& inputs);

}  // namespace kinora
