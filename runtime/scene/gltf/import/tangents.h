// runtime/scene/gltf/import/tangents.h: TANGENT as numbers that stay right when the surface is
// moved.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Adds tangent_u, tangent_v and tangent_flip to a group that has texture coordinates and normals.
// `tangents` are four numbers a vertex, counted from first_vertex on.
void add_tangents(const std::vector<dvec3>& positions, uint32_t first_vertex,
                  std::span<const float> tangents, PrimitiveGroup& group);

}  // namespace kinora
