// runtime/picture/shading/ray_services.h: the services that shoot rays (rsl/model/services.def),
// for one lane group of a grid.
#pragma once

#include <memory>
#include <vector>

#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/rays/gather_records.h"

namespace kinora {

class HitShader;
class MapTables;
class RayQueue;

class RayServices {
  public:
    RayServices(const ShadingFrame& frame, RayQueue& queue, MapTables& maps)
        : frame_(frame), queue_(queue), maps_(maps) {}

    void trace(Grid& grid, const jit::ServiceCall& call);
    void transmission(Grid& grid, const jit::ServiceCall& call);
    void occlusion(Grid& grid, const jit::ServiceCall& call);
    void indirect_diffuse(Grid& grid, const jit::ServiceCall& call);

  private:
    const ShadingFrame& frame_;
    RayQueue& queue_;
    MapTables& maps_;
};

class GatherRays {
  public:
    GatherRays(const ShadingFrame& frame, HitShader& hits, RayQueue& queue, MapTables& maps)
        : frame_(frame), hits_(hits), queue_(queue), maps_(maps) {}

    void begin_frame(size_t threads);
    // All rays of a statement; the handle of its records.
    int32_t gather(Grid& grid, const jit::ServiceCall& call);

  private:
    class Call;
    GatherMemory& records_of(const Grid& grid, int nesting);

    const ShadingFrame& frame_;
    HitShader& hits_;
    RayQueue& queue_;
    MapTables& maps_;
    // [thread][depth and nesting]
    std::vector<std::vector<std::unique_ptr<GatherMemory>>> memories_;
};

}  // namespace kinora
