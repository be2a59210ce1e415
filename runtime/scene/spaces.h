// runtime/scene/spaces.h: the coordinate systems that shaders name.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/base/math.h"

namespace kinora {

struct Pose;
struct SceneNodes;

// Whose "object" and "shader" space is meant: a scene node's (kNone: the world's). That of a light
// on it is RenderMan's: x right, y up, z where the light looks, which is the node's with z
// mirrored.
struct SpaceOwner {
    uint32_t node;
    bool light = false;
    SpaceOwner(uint32_t n, bool is_light = false) : node(n), light(is_light) {}
};

// current_from_space of a named space in a pose: "world", "camera", "current",
// "screen", "NDC", "raster", "object"/"shader" of the owner, or a node's id. Composed in double. A
// name that is none of these means "shader".
dmat4 current_from_space(const SceneNodes& scene, const Pose& pose, std::string_view name,
                         SpaceOwner owner);

// The same with the space of scene node `object` as "current": what vertices are displaced in.
dmat4 object_from_space(const SceneNodes& scene, const Pose& pose, std::string_view name,
                        uint32_t object);

}  // namespace kinora
