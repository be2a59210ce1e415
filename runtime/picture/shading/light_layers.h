// runtime/picture/shading/light_layers.h: kernels that run again with some of their light taken
// away: lights and rays answer as they did (docs/render.md#layers-of-light).
#pragma once

#include "runtime/picture/shading/frame/answer_tape.h"
#include "runtime/picture/shading/grid_host.h"
#include "runtime/picture/shading/kernel_runner.h"

namespace kinora {

// The layers of a scene's outputs, and one that has what those leave, so that sums can be judged;
// none where no output is of light.
std::vector<LightLayer> find_light_layers(const ShadingFrame& frame);

// A kernel whose lights and rays are noted.
class TapingHost final : public GridHost {
  public:
    using GridHost::GridHost;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirectdiffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void raylimit(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void samplinglights(const jit::ServiceCall& call) override;

  private:
    void keep(rsl::Service service, const jit::ServiceCall& call);
    void keep_lights(rsl::Service service, const jit::ServiceCall& call);
};

// The same kernel in some of that light. What hides light still does. A call that the kernel did
// not make before is answered as if rays met nothing.
class ReplayHost final : public RelitHost {
  public:
    ReplayHost(Grid& grid, const GridServices& services, const LightPart& part);
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirectdiffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void raylimit(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void samplinglights(const jit::ServiceCall& call) override;

  private:
    bool replay(rsl::Service service, const jit::ServiceCall& call);

    const LightPart& part_;
    const std::span<float> zeros_;
    int32_t group_ = -1;  // the first lane of the group whose records are after the mark
    Arena::Mark mark_{};
};

// Columns of a light's record, as a surface reads it.
size_t light_columns_of(const rsl::LoweredShader& look);

// The part's records of lights at all points; dark ones stand for the others'.
jit::RecordSet records_of_part(const Grid& grid, const jit::RecordSet& set, const LightPart& part);

// A finding that names the shaders whose layers do not sum to the picture; false: none is such.
bool report_layer_errors(const SceneShaders& shaders, const LayerErrors& errors,
                         Diagnostics& diagnostics);

// Gives the grid a tape if it has points of layers; returns whether it does.
bool start_tape(Grid& grid, const raytrace::ShadeResult& result);
// Fills the planes of the layers at the points of a grid, whose kernel gave `Ci` with a tape;
// `result` has what the points show.
void fill_light_layers(Grid& grid, const KernelRunner& kernels, const float* const Ci[3],
                       const raytrace::ShadeResult& result, LayerErrors& errors);
// The same for a volume, which takes each layer as its own Ci; what it adds without light goes to
// the emission. Its grid has a tape.
void pass_light_layers(Grid& grid, const BoundKernel& bound, const KernelRunner& kernels,
                       const raytrace::ShadeResult& result);
// Where nothing is met, all that is seen is emission.
void fill_layers_of_misses(const ShadingFrame& frame, size_t count,
                           const raytrace::ShadeResult& result);

}  // namespace kinora
