// runtime/shading/services.h: the objects that answer the kernels of a grid.
#pragma once

namespace kinora {

class Bakes;
class GatherRays;
class LightRecords;
class Prints;
class RayServices;

struct GridServices {
    LightRecords& lights;
    RayServices& rays;
    GatherRays& gathers;
    Prints& prints;
    Bakes& bakes;
};

}  // namespace kinora
