// runtime/scene/load/smooth_normals.h: normals by crease angle for meshes that have none.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Groups without normals get smooth ones with creases: where the
// faces at an edge differ by more than the angle, where more than two meet, or only one is, the
// surface is not smooth across it. Faces count by their angle at the vertex. Positions that are
// equal are one. A morph's creases are those of its base and of its targets, which get normals of
// their own shapes between them.
// A mesh all of whose faces stay flat gets none: it is drawn flat, also where it deforms.
void smooth_normals(SceneDescription& description, double degrees);

// Groups without normals get those of their faces, for formats whose readers would smooth them.
void flat_normals(SceneDescription& description);

}  // namespace kinora
