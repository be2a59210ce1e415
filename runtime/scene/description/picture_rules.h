// runtime/scene/description/picture_rules.h: what the picture shows of a description. The builder
// of scenes and the writers of files use the same rules.
#pragma once

#include <string>
#include <string_view>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// The node and all below it are not there.
inline bool hides(const NodeDefinition& node) {
    return node.hidden || node.invisible;
}

// Whether the scene has a mesh that no node hides.
bool shows_a_mesh(const SceneDescription& description);

// The attribute that a semantic names: the first one of that set; kNone: of the lowest set. Null
// where there is none.
const VertexAttribute* find_attribute(const PrimitiveGroup& group, std::string_view semantic,
                                      uint32_t set = kNone);

// The vertex normals that the picture has: of the lowest set. Null where the group is flat.
const VertexAttribute* normals_of(const PrimitiveGroup& group);

// What the instance binds a name to; null where it binds nothing.
const VertexBinding* find_binding(const MaterialUse* use, std::string_view name);

// The texture coordinates that a texcoord name means on a group: those it is bound to, else those
// of the lowest set. Null where there are none.
const VertexAttribute* texture_coordinates(const PrimitiveGroup& group, const MaterialUse* use,
                                           std::string_view texcoord);

}  // namespace kinora
