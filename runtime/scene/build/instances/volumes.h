// runtime/scene/build/instances/volumes.h: shader instances of volumes: what fills or surrounds
// objects, and the atmosphere.
#pragma once

#include <map>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// Writes Scene::volumes and looks.
class VolumeInstances {
  public:
    VolumeInstances(const SceneDescription& description, const SceneShapes& shapes,
                    SceneShaders& scene, Diagnostics& diagnostics)
        : description_(description), shapes_(shapes), scene_(scene), diagnostics_(diagnostics) {}

    // Sets the surface's interior, exterior and atmosphere where the material has them.
    void add(Surface& surface, const MaterialDefinition& material, const MaterialUse* use);

  private:
    uint32_t add_volume(const std::vector<ShaderUse>& layers, const std::string& name,
                        uint32_t node, const MaterialUse* use, bool exterior);
    uint32_t add_atmosphere(uint32_t atmosphere);

    const SceneDescription& description_;
    const SceneShapes& shapes_;
    SceneShaders& scene_;
    Diagnostics& diagnostics_;
    std::map<std::string, uint32_t> by_key_;    // kNone: there were too many
    std::map<uint32_t, uint32_t> atmospheres_;  // by SceneDescription::atmospheres
};

// The camera's, in its space; else the scene's, in world space. Writes Scene::atmosphere and looks.
void add_atmosphere(const SceneDescription& description, const CameraSource& camera,
                    SceneShaders& scene);

}  // namespace kinora
