// runtime/scene/spaces.h: the coordinate systems that shaders name.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/base/math.h"

namespace kinora {

struct Scene;

// current_from_space of a named space at the scene's present state: "world", "camera", "current",
// "screen", "NDC", "raster", "object"/"shader" of scene node `node` (kNone: world), or a node's id.
// Composed in double. A name that is none of these means "shader".
dmat4 current_from_space(const Scene& scene, std::string_view name, uint32_t node);

// The same with the space of scene node `object` as "current": what vertices are displaced in.
dmat4 object_from_space(const Scene& scene, std::string_view name, uint32_t object);

}  // namespace kinora
