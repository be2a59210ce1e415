// runtime/scene/build/instances/volumes.h: shader instances of volumes: what fills or surrounds
// objects, and the atmosphere.
#pragma once

#include <map>
#include <string>

#include "runtime/scene/scene.h"

namespace kinora {

// Writes Scene::volumes and looks.
class VolumeInstances {
  public:
    VolumeInstances(Scene& scene, Diagnostics& diagnostics)
        : scene_(scene), diagnostics_(diagnostics) {}

    // Sets the surface's interior and exterior where the material has them.
    void add(Surface& surface, const MaterialDefinition& material, const MaterialUse* use);

  private:
    uint32_t add_volume(const std::vector<ShaderUse>& layers, const std::string& name,
                        uint32_t node, const MaterialUse* use, bool exterior);

    Scene& scene_;
    Diagnostics& diagnostics_;
    std::map<std::string, uint32_t> by_key_;  // kNone: there were too many
};

// The camera's, in its space; else the scene's, in world space. Writes Scene::atmosphere and looks.
void add_atmosphere(Scene& scene);

}  // namespace kinora
