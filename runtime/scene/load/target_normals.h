// runtime/scene/load/target_normals.h: corners of a morph's base that its targets tell apart.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Corners of one position that share a normal of the base, but not those of every target, get
// entries of their own in the base: its normals then follow each target's, as if each corner
// were a vertex. Targets with other corners than the base's do not count.
void part_normals_by_targets(SceneDescription& description);

}  // namespace kinora
