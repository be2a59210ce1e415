// runtime/picture/shading/grid_host.h: a scene's answers to its kernels at the points of a grid.
#pragma once

#include "runtime/scene/kernels/stratified_kernels.h"
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

// What a kernel over the points of a grid is answered whenever it runs.
class PictureHost : public SceneHost {
  public:
    PictureHost(Grid& grid, const GridServices& services);
    Grid& grid() const { return grid_; }
    const GridServices& services() const { return services_; }

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirectdiffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void raylimit(const jit::ServiceCall& call) override;
    void stratified(const jit::ServiceCall& call) override;
    void samplewish(const jit::ServiceCall& call) override;
    void lightsample(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;

  protected:
    Grid& grid_;
    const GridServices& services_;

  private:
    void place_samples(int32_t first);

    // What the lanes from `placed_` on draw from; kept, as a loop draws from it again and again.
    SamplePlaces places_;
    int32_t placed_ = -1;
};

// A kernel that shades its points.
class GridHost : public PictureHost {
  public:
    using PictureHost::PictureHost;
    void print(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void samplinglights(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall& call) override;
};

// A kernel that runs for the rays it sends, and will run again (docs/rays.md#full-packets): it
// prints and bakes nothing, and is in the dark.
class NotingHost final : public PictureHost {
  public:
    using PictureHost::PictureHost;
    void print(const jit::ServiceCall&) override {}
    void lights(const jit::ServiceCall& call) override;
    void samplinglights(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall&) override {}
};

// A kernel that runs once more in other light: no ray meets anything, and it prints and bakes
// nothing.
class RelitHost : public PictureHost {
  public:
    using PictureHost::PictureHost;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirectdiffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void print(const jit::ServiceCall&) override {}
    void lights(const jit::ServiceCall& call) override;
    void samplinglights(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall&) override {}
};

}  // namespace kinora
