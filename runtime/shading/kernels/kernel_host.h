// runtime/shading/kernels/kernel_host.h: what answers the services that a running kernel calls
// (rsl/model/services.def); KernelCall::host points to one.
#pragma once

#include <string_view>

#include "jit/ir/kernel.h"
#include "runtime/base/math.h"
#include "runtime/description/texture_name.h"

namespace kinora {

class TextureStore;

// Textures and coordinate systems are all that a host must have. What it does not know is nothing:
// all results 0.
class KernelHost {
  public:
    virtual ~KernelHost() = default;

    virtual TextureStore& textures() const = 0;
    virtual TextureFilter best_filter() const { return TextureFilter::Anisotropic; }
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
    virtual void ray_limit(const jit::ServiceCall& call);
    virtual void query(const jit::ServiceCall& call);
    virtual void bake3d(const jit::ServiceCall& call);
    virtual void texture3d(const jit::ServiceCall& call);
    virtual void photons(const jit::ServiceCall& call);
};

// The function behind a service's name: its KernelCall::host is asked. An unknown name stops the
// program.
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
