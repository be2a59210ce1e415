// runtime/scene/build/instances/output_planes.h: the planes that surfaces' output parameters fill.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

// Writes Scene::outputs.
class OutputPlanes {
  public:
    // Planes that are wanted, then those that the imagers have parameters of. The scene has the
    // instances of its surfaces.
    OutputPlanes(SceneShaders& scene, std::span<const std::string> wanted,
                 std::span<const ShaderUse> imagers, Diagnostics& diagnostics);

    // The output parameters behind the planes.
    const std::vector<std::string>& parameters() const { return parameters_; }

  private:
    bool add(const std::string& parameter, bool in_file);

    SceneShaders& scene_;
    std::vector<std::string> parameters_;
};

// Where a compiled instance of a surface has the planes among its outputs.
void bind_planes(std::span<const OutputPlane> planes, ShaderInstance& instance);

}  // namespace kinora
