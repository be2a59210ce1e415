// runtime/scene/build/shapes/mesh.h: a mesh as read to a mesh as rendered.
#pragma once

#include "runtime/scene/shapes.h"

namespace kinora {

// Positions become floats relative to the centre of their bounds; normals become entries that name
// their position. Groups without normals are flat. With `deforms` a normal that several positions
// share is split, so that each can follow its own position.
Mesh build_mesh(const MeshDefinition& definition, bool deforms);

}  // namespace kinora
