// runtime/picture/shading/ray_services.h: the services that shoot rays (rsl/model/services.def),
// for one lane group of a grid.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "runtime/picture/shading/grid.h"
#include "runtime/scene/images/environment_table.h"

namespace kinora {

class HitShader;
class TextureStore;
class NestedRays;
class Transmission;

// Light of an environment map along directions in world space, filtered over `width` radians.
void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, float width,
                  vec3* light);

class RayServices {
  public:
    RayServices(const ShadingFrame& frame, NestedRays& nested, Transmission& transmission)
        : frame_(frame), nested_(nested), transmission_(transmission) {}

    void trace(Grid& grid, const jit::ServiceCall& call);
    void transmission(Grid& grid, const jit::ServiceCall& call);
    void occlusion(Grid& grid, const jit::ServiceCall& call);
    void indirect_diffuse(Grid& grid, const jit::ServiceCall& call);

  private:
    class Passing;

    const ShadingFrame& frame_;
    NestedRays& nested_;
    Transmission& transmission_;
};

// The records of one gather statement at one depth; kept from frame to frame.
struct GatherMemory {
    std::vector<float> values;
    std::vector<const float*> columns;
    std::vector<jit::Record> records;
};

class GatherRays {
  public:
    GatherRays(const ShadingFrame& frame, HitShader& hits) : frame_(frame), hits_(hits) {}

    void begin_frame(size_t threads);
    // All rays of a statement; the handle of its records.
    int32_t gather(Grid& grid, const jit::ServiceCall& call);

  private:
    class Call;
    GatherMemory& records_of(const Grid& grid, int nesting);
    // Null where the map's light does not come from a small part of it.
    const EnvironmentTable* table_of(int32_t map);

    const ShadingFrame& frame_;
    HitShader& hits_;
    // [thread][depth and nesting]
    std::vector<std::vector<std::unique_ptr<GatherMemory>>> memories_;
    std::mutex tables_mutex_;
    std::map<int32_t, EnvironmentTable> tables_;  // by map
};

}  // namespace kinora
