// runtime/scene/build/displacement/diced_attributes.h: vertex inputs of surfaces whose mesh was
// diced.
#pragma once

#include "runtime/scene/build/displacement/displaced_mesh.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

struct SceneShaders;

// Gives the diced mesh the attributes that shader instances want beyond those of the file, and
// makes the vertex inputs of the surfaces (Scene::surfaces: st, varying) those of the diced mesh.
void bind_diced_attributes(SceneShapes& shapes, const SceneShaders& shaders,
                           const DisplacedMesh& mesh, DicedMesh& made);

}  // namespace kinora
