// runtime/programs/shade/co_shaders.h: a source with the co-shaders of --coshader.
#pragma once

#include <memory>

#include "rsl/link.h"
#include "runtime/programs/shade/source.h"

namespace kinora {

// How many numbers or texts the source or the command line gives each parameter of the co-shader,
// or of the shader itself ("").
rsl::LinkCounts bound_counts(const ShadeOptions& options, const ShadeSource& source,
                             const std::string& handle);

// Of --param, for an array of strings: commas divide them.
std::vector<std::string> split_texts(const std::string& text);

// Reads and compiles them as one shader; null after a finding. --param of strings and of parameters
// of type shader decide which are called.
std::unique_ptr<rsl::Shader> compile_with_co_shaders(const ShadeOptions& options,
                                                     ShadeSource& source);

}  // namespace kinora
