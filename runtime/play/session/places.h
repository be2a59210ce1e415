// runtime/play/session/places.h: nodes by their names, and where they stand.
#pragma once

#include <optional>
#include <string>

#include "runtime/base/math.h"
#include "runtime/scene/scene.h"

namespace kinora {

// "torso/head/eye", by ids.
std::string node_path(const Scene& scene, uint32_t node);
uint32_t find_node(const Scene& scene, const std::string& path_id_or_name);  // kNone: none

// Where a node stands at a time, in seconds; the scene is evaluated there. Nothing where there is
// none of that name.
std::optional<dvec3> place_at(Scene& scene, const std::string& node, double seconds);

}  // namespace kinora
