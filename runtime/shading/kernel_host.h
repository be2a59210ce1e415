// runtime/shading/kernel_host.h: what answers the services that a running kernel calls
// (rsl/model/services.def); KernelCall::host points to one.
#pragma once

#include <string>
#include <string_view>

#include "jit/ir/kernel.h"
#include "runtime/base/math.h"

namespace kinora {

class TextureStore;
struct Grid;
struct GridServices;
struct Scene;
struct ShaderInstance;

// Textures and coordinate systems are all that a host must have. What it does not know is nothing:
// all results 0.
class KernelHost {
  public:
    virtual ~KernelHost() = default;

    virtual TextureStore& textures() const = 0;
    // `point`: of the kernel's points, for spaces that differ among them.
    virtual dmat4 current_from_space(std::string_view name, size_t point) const = 0;
    virtual dmat4 world_from_current() const = 0;
    virtual void print(const jit::ServiceCall& call) = 0;

    virtual void lights(const jit::ServiceCall& call);
    virtual void trace(const jit::ServiceCall& call);
    virtual void transmission(const jit::ServiceCall& call);
    virtual void occlusion(const jit::ServiceCall& call);
    virtual void indirect_diffuse(const jit::ServiceCall& call);
    virtual void gather(const jit::ServiceCall& call);
    virtual void query(const jit::ServiceCall& call);
    virtual void bake3d(const jit::ServiceCall& call);
    virtual void texture3d(const jit::ServiceCall& call);
    virtual void photons(const jit::ServiceCall& call);
};

// The function behind a service's name: its KernelCall::host is asked. An unknown name stops the
// program.
jit::ServiceFn find_service(std::string_view name);

// A shader instance of a scene at frame rate: no points, no lights, no rays.
class SceneHost : public KernelHost {
  public:
    SceneHost(const Scene& scene, const ShaderInstance& look) : scene_(scene), look_(look) {}

    TextureStore& textures() const override;
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    // At once: once per instance and frame.
    void print(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    void texture3d(const jit::ServiceCall& call) override;
    void photons(const jit::ServiceCall& call) override;

  protected:
    const Scene& scene_;
    const ShaderInstance& look_;
};

// A kernel that moves vertices: "current" is the space of `object`, a scene node.
class VertexHost : public SceneHost {
  public:
    VertexHost(const Scene& scene, const ShaderInstance& look, uint32_t object, std::string& prints)
        : SceneHost(scene, look), object_(object), prints_(prints) {}

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void print(const jit::ServiceCall& call) override;

  private:
    uint32_t object_;
    std::string& prints_;  // of this part of the vertices
};

// A kernel over the points of a grid.
class GridHost : public SceneHost {
  public:
    GridHost(Grid& grid, const GridServices& services);

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void print(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void occlusion(const jit::ServiceCall& call) override;
    void indirect_diffuse(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    void bake3d(const jit::ServiceCall& call) override;

  private:
    Grid& grid_;
    const GridServices& services_;
};

}  // namespace kinora
