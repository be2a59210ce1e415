// runtime/scene/build/instances/surface_instances.h: shader instances of surfaces.
#pragma once

#include <map>
#include <string>

#include "runtime/scene/build/instances/vertex_instances.h"
#include "runtime/scene/build/instances/volumes.h"
#include "runtime/scene/build/shapes/surface_use.h"

namespace kinora {

// Writes Scene::looks; they are not compiled yet.
class SurfaceInstances {
  public:
    SurfaceInstances(const SceneResources& resources, const SceneShapes& shapes,
                     SceneShaders& scene, VertexInstances& vertices, VolumeInstances& volumes,
                     Diagnostics& diagnostics);

    // Sets all that the surface has of its material: st, varying inputs and instances.
    void add(Surface& surface, const SurfaceUse& use);

  private:
    const MaterialDefinition& default_material();
    std::vector<ShaderUse> emitter(const MaterialDefinition& material);
    std::vector<ShaderUse> with_surfaces(std::vector<ShaderUse> layers,
                                         const MaterialDefinition& material);
    uint32_t find_or_add(KeyedInstance made);

    const SceneResources& resources_;
    const SceneShapes& shapes_;
    SceneShaders& scene_;
    VertexInstances& vertices_;
    VolumeInstances& volumes_;
    Diagnostics& diagnostics_;
    std::map<std::string, uint32_t> by_key_;
    MaterialDefinition default_material_;  // no surfaces until it is wanted
};

}  // namespace kinora
