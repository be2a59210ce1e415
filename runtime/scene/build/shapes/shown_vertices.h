// runtime/scene/build/shapes/shown_vertices.h: the vertices of triangles, where they stand in the
// world.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"

namespace kinora {

class ShownVertices {
  public:
    // The scene's shapes are there; how they stand may change afterwards.
    ShownVertices(const SceneShapes& scene, const Pose& pose);

    // Those of one shape as it stands now, each once, without those that are not finite. Valid
    // until the next call.
    std::span<const dvec3> of(uint32_t shape);

  private:
    const SceneShapes& scene_;
    const Pose& pose_;
    std::vector<std::vector<uint32_t>> used_;  // positions of each mesh that a triangle has
    std::vector<dvec3> world_;
};

}  // namespace kinora
