// runtime/scene/description/shader_library.h: the shaders of assets/shaders, compiled into the
// program: COLLADA's lights and fixed-function materials, the default surface, the standard
// shaders.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "rsl/compile.h"
#include "runtime/base/diagnostic.h"

namespace kinora {

// The shader of that name (its file's name without .sl); compiled on first use. A name that is not
// in the library gives null; an error in a library shader is a bug (CHECK).
std::shared_ptr<const rsl::Shader> library_shader(std::string_view name);

// Its text as in assets/shaders; "" for a name that is not in the library.
std::string_view library_shader_text(std::string_view name);

// All names, sorted.
const std::vector<std::string_view>& library_shader_names();

}  // namespace kinora
