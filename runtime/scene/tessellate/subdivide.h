// runtime/scene/tessellate/subdivide.h: triangles on the limit of a Catmull-Clark mesh.
#pragma once

#include "runtime/scene/tessellate/tessellate.h"

namespace kinora {

// Vertices and vertex variables are at their limits; others are bilinear on each face. Attributes
// are those of tessellate(); UV goes from 0 to 1 over each face of four points, from its first to
// its third, and over each of the quads that other faces become. All faces are subdivided alike, at
// least as often as faces without four points need, however many triangles that is.
Tessellation subdivide(const SubdivisionSurface& surface, const PictureScale& scale,
                       const TessellationLimits& limits = {});

}  // namespace kinora
