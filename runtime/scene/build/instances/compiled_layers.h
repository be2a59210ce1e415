// runtime/scene/build/instances/compiled_layers.h: what shader instances share whose shaders and
// bindings are of one shape.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <unordered_map>

#include "jit/compiler.h"
#include "rsl/lower/lower.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/build/instances/compile_instance.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

struct CompiledLayers {
    rsl::LoweredShader lowered;  // without its module
    jit::KernelPair full;
    std::optional<jit::KernelPair> opacity;  // as ShaderInstance has it
};

// By all that instances of one scene differ in.
class KnownLayers : public std::unordered_map<std::string, CompiledLayers> {};

// The kernels of the look's layers (bound_layers()), known or compiled now. Null where a shader
// cannot be compiled; findings say why.
const CompiledLayers* find_or_compile(const ShaderInstance& look,
                                      std::span<const rsl::Layer> layers,
                                      const ShaderInstanceOptions& options, KnownLayers& known,
                                      Diagnostics& diagnostics);

}  // namespace kinora
