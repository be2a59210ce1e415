// runtime/shading/services.h: what shaders call while they run (rsl/model/services.def).
#pragma once

#include <string_view>

#include "jit/ir/kernel.h"

namespace kinora {

// The function behind a service's name; an unknown name stops the program.
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
