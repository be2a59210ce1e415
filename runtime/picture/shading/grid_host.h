// runtime/picture/shading/grid_host.h: a scene's answers to its kernels at the points of a grid.
#pragma once

#include "runtime/scene/shaders/scene_host.h"

namespace kinora {

class Bakes;
class GatherRays;
class LightRecords;
class Prints;
class RayServices;
struct Grid;

// The objects that answer the kernels of a grid.
struct GridServices {
    LightRecords& lights;
    RayServices& rays;
    GatherRays& gathers;
    Prints& prints;
    Bakes& bakes;
};

// A kernel over the points of a grid.
class GridHost : public SceneHost {
  public:
    GridHost(Grid& grid, const GridServices& services);
    Grid& grid() const { return grid_; }
    const GridServices& services() const { return services_; }

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void print(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirectdiffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void raylimit(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall& call) override;

  private:
    Grid& grid_;
    const GridServices& services_;
};

}  // namespace kinora
