// runtime/scene/kernels/kernel_host.h: what answers the services that a running kernel calls
// (rsl/model/services.def); KernelCall::host points to one.
#pragma once

#include <string_view>

#include "jit/ir/kernel.h"
#include "rsl/model/service_table.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/texture_name.h"

namespace kinora {

class TextureStore;

// A member a service: a host that does not say how it answers one does not compile.
class KernelHost {
  public:
    virtual ~KernelHost() = default;

#define SERVICE(name, arguments, results, effects, doc) \
    virtual void name(const jit::ServiceCall& call) = 0;
#define STRING_SERVICE(name, arguments, results, effects, doc)
#include "rsl/model/services.def"
};

// Inside a host: its answer to the service is that it knows nothing. All results are 0.
#define KINORA_UNANSWERED(service)                                \
    void service(const jit::ServiceCall& call) override {         \
        rsl::answer_zeros<::kinora::rsl::Service::service>(call); \
    }

// A host with textures and coordinate systems, which answer what needs nothing else.
class WorldHost : public KernelHost {
  public:
    virtual TextureStore& textures() const = 0;
    virtual TextureFilter best_filter() const { return TextureFilter::Anisotropic; }
    // `point`: of the kernel's points, for spaces that differ among them.
    virtual dmat4 current_from_space(std::string_view name, size_t point) const = 0;
    virtual dmat4 world_from_current() const = 0;

    void texture(const jit::ServiceCall& call) override;
    void environment(const jit::ServiceCall& call) override;
    void maplight(const jit::ServiceCall& call) override;
    void mapdensity(const jit::ServiceCall& call) override;
    void mapdirection(const jit::ServiceCall& call) override;
    void shadow(const jit::ServiceCall& call) override;
    void textureinfo(const jit::ServiceCall& call) override;
    void transform(const jit::ServiceCall& call) override;
    void stratified(const jit::ServiceCall& call) override;  // a sequence a point
};

// The function behind a service's name: its KernelCall::host answers. An unknown name stops the
// program.
jit::ServiceFn find_service(std::string_view name);

}  // namespace kinora
