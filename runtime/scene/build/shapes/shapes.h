// runtime/scene/build/shapes/shapes.h: meshes on nodes.
#pragma once

#include <vector>

#include "runtime/scene/build/shapes/skins.h"
#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

// A repeated static mesh is instanced when all of it, baked, would be more triangles than this: an
// instance level costs 20-29 % of the trace rate (docs/decisions.md#two-levels-where-they-pay).
inline constexpr size_t kBakedTriangles = 200'000;

// Writes Scene::meshes, morphs, shapes and surfaces; gives the description's use of each surface.
// The description loses positions and triangles that nothing reads again.
std::vector<SurfaceUse> add_shapes(const SceneNodes& nodes, SceneShapes& scene, Pose& start,
                                   const SkinBinder& skins, Diagnostics& diagnostics);

}  // namespace kinora
