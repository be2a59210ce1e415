// runtime/shading/services.h: what shaders call while they run (rsl/model/services.def).
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

// The function behind a service's name; an unknown name stops the program.
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
