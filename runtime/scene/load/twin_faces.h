// runtime/scene/load/twin_faces.h: faces that lie on others and are turned the other way.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Modellers that paint both sides of a face write it twice, the corners of the second the other way
// round, each with its material. Of such pairs each face is seen from its front alone: from either
// side one would lie as near as the other. Pairs of one material stay as they are. Groups are
// parted where some of their faces have a twin and others none. Meshes of more than kMostTwins
// triangles, and those of morphs, are left alone.
void part_twin_faces(SceneDescription& description);

inline constexpr size_t kMostTwins = size_t(1) << 22;

}  // namespace kinora
