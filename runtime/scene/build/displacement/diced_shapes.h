// runtime/scene/build/displacement/diced_shapes.h: shapes whose mesh was diced.
#pragma once

#include "runtime/scene/build/displacement/displaced_mesh.h"
#include "runtime/scene/vertices/dice_error.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

struct Scene;

// Puts a diced mesh on its shapes, and moves its vertices or readies them to be moved at each
// frame. Takes the mesh over into Scene::meshes, adds to Scene::morphs, changes the shapes and
// their surfaces' vertex inputs. `watched` (null: nothing of it was diced) gets what deforms it.
void put_on_shapes(Scene& scene, const DisplacedMesh& mesh, DicedMesh& made, const MeshUse& use,
                   WatchedEdges* watched, Diagnostics& diagnostics);

}  // namespace kinora
