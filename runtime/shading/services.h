// runtime/shading/services.h: what shaders call while they run (rsl/model/renderer_services.h).
#pragma once

#include <string_view>

#include "jit/ir/kernel.h"

namespace kinora {

class Bakes;
class GatherRays;
class LightRecords;
class Prints;
class RayServices;

// The objects that answer the kernels of a grid.
struct GridServices {
    LightRecords& lights;
    RayServices& rays;
    GatherRays& gathers;
    Prints& prints;
    Bakes& bakes;
};

// The function behind a service's name; every name of rsl::kServiceNames has one (CHECK).
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
