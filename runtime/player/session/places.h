// runtime/player/session/places.h: nodes by their names, and where they stand.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "runtime/base/math.h"
#include "runtime/scene/names.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"

namespace kinora {

struct SceneShapes;

// By node_path(), id or name. kNone: there is none.
uint32_t find_node(const SceneNodes& scene, const std::string& path_id_or_name);

// The box around what is on the node and below it, as it stands; nothing: low > high.
std::pair<dvec3, dvec3> box_of(const SceneNodes& scene, const SceneShapes& shapes, const Pose& pose,
                               uint32_t node);

// Where a node stands at a time, in seconds; the pose is evaluated there. Nothing where there is
// none of that name.
std::optional<dvec3> place_at(const SceneNodes& scene, Pose& pose, const std::string& node,
                              double seconds);

}  // namespace kinora
