// runtime/shading/services.h: what shaders ask of the renderer while they run
// (rsl/model/renderer_services.h).
#pragma once

#include <string_view>

#include "jit/ir/kernel.h"

namespace kinora {

// The function behind a service's name; every name of rsl::kServiceNames has one (CHECK).
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
