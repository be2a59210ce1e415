// runtime/programs/shade/co_shaders.h: a source with the co-shaders of --coshader.
#pragma once

#include <memory>

#include "rsl/compile.h"
#include "runtime/programs/shade/source.h"

namespace kinora {

// Reads and compiles them as one shader; null after a finding. --param of strings and of parameters
// of type shader decide which are called.
std::unique_ptr<rsl::Shader> compile_with_co_shaders(const ShadeOptions& options,
                                                     ShadeSource& source);

}  // namespace kinora
