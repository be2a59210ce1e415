// runtime/scene/build/shapes/morphs.h: morph targets of a shape.
#pragma once

#include "runtime/base/diagnostic.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// The morph's targets, into Scene::morphs the first time, and the shape's buffers for their result.
// Positions and normals are those of the shape's mesh.
void add_morph(const SceneDescription& description, SceneShapes& scene, uint32_t morph,
               Shape& shape, Diagnostics& diagnostics);

}  // namespace kinora
