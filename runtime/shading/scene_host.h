// runtime/shading/scene_host.h: a scene's answers to its kernels: at frame rate, at the points of a
// grid and at vertices.
#pragma once

#include "runtime/shading/kernels/kernel_host.h"
#include "runtime/shading/print.h"

namespace kinora {

class Bakes;
class GatherRays;
class LightRecords;
class Prints;
class RayServices;
struct Grid;
struct Pose;
struct Scene;
struct ShaderInstance;

// What a scene answers wherever its kernel runs.
class SceneHost : public WorldHost {
  public:
    SceneHost(const Scene& scene, const Pose& pose, const ShaderInstance& look)
        : scene_(scene), pose_(pose), look_(look) {}

    TextureStore& textures() const override;
    TextureFilter best_filter() const override;
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    void texture3d(const jit::ServiceCall& call) override;
    void photons(const jit::ServiceCall& call) override;

  protected:
    const Scene& scene_;
    const Pose& pose_;
    const ShaderInstance& look_;
};

// A kernel that does not run at points of a picture: no lights, no rays, nothing is baked.
class UnlitHost : public SceneHost {
  public:
    using SceneHost::SceneHost;
    void query(const jit::ServiceCall& call) override;
    KINORA_UNANSWERED(lights)
    KINORA_UNANSWERED(trace)
    KINORA_UNANSWERED(transmission)
    KINORA_UNANSWERED(occlusion)
    KINORA_UNANSWERED(indirectdiffuse)
    KINORA_UNANSWERED(gather)
    KINORA_UNANSWERED(raylimit)
    KINORA_UNANSWERED(bake3d)
};

// A shader instance at frame rate.
class FrameHost : public UnlitHost {
  public:
    using UnlitHost::UnlitHost;
    // Once per instance and frame; the caller shows it.
    void print(const jit::ServiceCall& call) override;
    const PrintedLines& printed() const { return printed_; }

  private:
    PrintedLines printed_;
};

// A kernel that moves vertices: "current" is the space of `object`, a scene node.
class VertexHost : public UnlitHost {
  public:
    VertexHost(const Scene& scene, const Pose& pose, const ShaderInstance& look, uint32_t object,
               PrintedLines& prints)
        : UnlitHost(scene, pose, look), object_(object), prints_(prints) {}

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void print(const jit::ServiceCall& call) override;

  private:
    uint32_t object_;
    PrintedLines& prints_;  // of this part of the vertices
};

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
