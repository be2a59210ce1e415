// runtime/load/smooth_normals.h: --smooth DEGREES: normals for meshes that have none.
#pragma once

#include "runtime/description/scene_description.h"

namespace kinora {

// Groups without normals get smooth ones with creases: where the faces at an edge differ by more
// than the angle, where more than two meet, or only one is, the surface is not smooth across it.
// Faces count by their angle at the vertex. Positions that are equal are one. Morph targets get
// those of their own shape between the same creases.
void smooth_normals(SceneDescription& description, double degrees);

}  // namespace kinora
