// runtime/scene/build/instances/instance_compiler.h: shader instances compiled for a scene.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/build/instances/compile_instance.h"
#include "runtime/scene/build/instances/compiled_layers.h"
#include "runtime/scene/resources.h"

namespace kinora {

// Knows what holds for all instances: the scene's options and the ids of its nodes, which shaders
// may name as spaces. Writes SceneOptions::dumps.
class InstanceCompiler {
  public:
    // The scene has all its nodes.
    InstanceCompiler(SceneResources& scene, Diagnostics& diagnostics);

    // `wanted` has what holds for instances of its kind: light_messages, aovs, gathered. False when
    // a shader cannot be compiled; it has been reported.
    bool compile(ShaderInstance& instance, ShaderInstanceOptions wanted = {});

  private:
    SceneResources& scene_;
    Diagnostics& diagnostics_;
    std::vector<std::string> space_names_;
    KnownLayers known_;
};

}  // namespace kinora
