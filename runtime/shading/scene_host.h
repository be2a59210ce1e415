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

// A shader instance of a scene at frame rate: no points, no lights, no rays.
class SceneHost : public KernelHost {
  public:
    SceneHost(const Scene& scene, const Pose& pose, const ShaderInstance& look)
        : scene_(scene), pose_(pose), look_(look) {}

    TextureStore& textures() const override;
    TextureFilter best_filter() const override;
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    // Once per instance and frame; the caller shows it.
    void print(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    void texture3d(const jit::ServiceCall& call) override;
    void photons(const jit::ServiceCall& call) override;

    const PrintedLines& printed() const { return printed_; }

  protected:
    const Scene& scene_;
    const Pose& pose_;
    const ShaderInstance& look_;

  private:
    PrintedLines printed_;
};

// A kernel that moves vertices: "current" is the space of `object`, a scene node.
class VertexHost : public SceneHost {
  public:
    VertexHost(const Scene& scene, const Pose& pose, const ShaderInstance& look, uint32_t object,
               PrintedLines& prints)
        : SceneHost(scene, pose, look), object_(object), prints_(prints) {}

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
    void indirect_diffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void ray_limit(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall& call) override;

  private:
    Grid& grid_;
    const GridServices& services_;
};

}  // namespace kinora
