// runtime/shading/kernels/kernel_host.cpp: the functions that generated code calls, and hosts that
// know nothing.
#include "runtime/shading/kernels/kernel_host.h"

#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "rsl/model/service_table.h"
#include "runtime/images/texture.h"

namespace kinora {

using rsl::Service;

void KernelHost::lights(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::lights>(call);
}
void KernelHost::trace(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::trace>(call);
}
void KernelHost::transmission(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::transmission>(call);
}
void KernelHost::occlusion(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::occlusion>(call);
}
void KernelHost::indirect_diffuse(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::indirectdiffuse>(call);
}
void KernelHost::gather(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::gather>(call);
}
void KernelHost::ray_limit(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::raylimit>(call);
}
void KernelHost::query(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::query>(call);
}
void KernelHost::bake3d(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::bake3d>(call);
}
void KernelHost::texture3d(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::texture3d>(call);
}
void KernelHost::photons(const jit::ServiceCall& call) {
    rsl::answer_zeros<Service::photons>(call);
}

namespace {

constexpr int kLanes = jit::kMaxLanes;

KernelHost& host_of(const jit::ServiceCall& call) {
    return *static_cast<KernelHost*>(call.grid);
}

// Hands a call on to the host.
template <void (KernelHost::*service)(const jit::ServiceCall&)>
void ask_host(const jit::ServiceCall& call) {
    (host_of(call).*service)(call);
}

void texture(const jit::ServiceCall& call) {
    lookup_texture(call, host_of(call).textures(), host_of(call).best_filter());
}
void environment(const jit::ServiceCall& call) {
    lookup_environment(call, host_of(call).textures(), host_of(call).best_filter());
}
void texture_info(const jit::ServiceCall& call) {
    lookup_texture_info(call, host_of(call).textures());
}
void shadow(const jit::ServiceCall& call) {
    lookup_shadow(call, host_of(call).world_from_current(), host_of(call).textures());
}

void transform(const jit::ServiceCall& call) {
    for (int i = 0; i < kLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        dmat4 to = host_of(call).current_from_space(rsl::interned(jit::bits_of(call.args[i])),
                                                    size_t(call.first + i));
        dmat4 from = glm::inverse(to);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                int entry = row * 4 + column;
                call.results[entry * kLanes + i] = float(to[column][row]);
                call.results[(12 + entry) * kLanes + i] = float(from[column][row]);
            }
    }
}

constexpr rsl::ServiceTable kServices = {
    .lights = ask_host<&KernelHost::lights>,
    .texture = texture,
    .environment = environment,
    .shadow = shadow,
    .textureinfo = texture_info,
    .trace = ask_host<&KernelHost::trace>,
    .transmission = ask_host<&KernelHost::transmission>,
    .occlusion = ask_host<&KernelHost::occlusion>,
    .indirectdiffuse = ask_host<&KernelHost::indirect_diffuse>,
    .gather = ask_host<&KernelHost::gather>,
    .raylimit = ask_host<&KernelHost::ray_limit>,
    .query = ask_host<&KernelHost::query>,
    .bake3d = ask_host<&KernelHost::bake3d>,
    .texture3d = ask_host<&KernelHost::texture3d>,
    .photons = ask_host<&KernelHost::photons>,
    .transform = transform,
    .print = ask_host<&KernelHost::print>,
};

}  // namespace

jit::ServiceFn find_service(std::string_view name) {
    return rsl::find_service(kServices, name);
}

}  // namespace kinora
