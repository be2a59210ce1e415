// runtime/scene/build/instances/compile_instance.h: a shader instance's kernels.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "jit/compiler.h"
#include "rsl/model/layer.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/quality/quality.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

class KnownLayers;  // runtime/scene/build/instances/compiled_layers.h

struct ShaderInstanceOptions {
    Quality quality;
    const jit::Target* target = nullptr;
    std::vector<std::string> light_messages;  // lights: names that some surface reads
    std::vector<std::string> aovs;            // surfaces: output parameters that the film keeps
    std::vector<std::string> gathered;  // surfaces: outputs that some gather reads of what it hits
    const std::vector<std::string>* spaces = nullptr;
    std::vector<std::pair<std::string, std::string>>* dumps = nullptr;
    // Looked up and added to. All instances of a kind that share it have the same options.
    KnownLayers* known = nullptr;
    bool own_lines = false;  // jit::CompileOptions
};

// The shaders as compile_instance() lowers them, their parameters bound.
std::vector<rsl::Layer> bound_layers(const ShaderInstance& look,
                                     const SceneDescription& description);

// Lowers and compiles; `look` has kind, layers, node and varying set. False when a shader cannot be
// compiled (findings say why).
bool compile_instance(ShaderInstance& look, const SceneDescription& description,
                      const ShaderInstanceOptions& options, Diagnostics& diagnostics);

}  // namespace kinora
