// runtime/scene/kernels/kernel_host.cpp: the functions that generated code calls, and answers
// from textures and coordinate systems.
#include "runtime/scene/kernels/kernel_host.h"

#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "runtime/scene/images/map_light.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/kernels/stratified.h"

namespace kinora {

void WorldHost::texture(const jit::ServiceCall& call) {
    lookup_texture(call, textures(), best_filter());
}
void WorldHost::environment(const jit::ServiceCall& call) {
    lookup_environment(call, textures(), best_filter());
}
void WorldHost::maplight(const jit::ServiceCall& call) {
    lookup_map_light(call, textures());
}
void WorldHost::mapdensity(const jit::ServiceCall& call) {
    lookup_map_density(call, textures());
}
void WorldHost::mapdirection(const jit::ServiceCall& call) {
    lookup_map_direction(call, textures());
}
void WorldHost::textureinfo(const jit::ServiceCall& call) {
    lookup_texture_info(call, textures());
}
void WorldHost::shadow(const jit::ServiceCall& call) {
    lookup_shadow(call, world_from_current(), textures());
}

void WorldHost::stratified(const jit::ServiceCall& call) {
    answer_stratified(call);
}

void WorldHost::transform(const jit::ServiceCall& call) {
    constexpr int kLanes = jit::kMaxLanes;
    for (int i = 0; i < kLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        dmat4 to =
            current_from_space(rsl::interned(jit::bits_of(call.args[i])), size_t(call.first + i));
        dmat4 from = glm::inverse(to);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                int entry = row * 4 + column;
                call.results[entry * kLanes + i] = float(to[column][row]);
                call.results[(12 + entry) * kLanes + i] = float(from[column][row]);
            }
    }
}

namespace {

// Hands a call on to the host.
template <void (KernelHost::*service)(const jit::ServiceCall&)>
void ask_host(const jit::ServiceCall& call) {
    (static_cast<KernelHost*>(call.grid)->*service)(call);
}

constexpr rsl::ServiceTable kServices = {
#define SERVICE(name, arguments, results, effects, doc) .name = ask_host<&KernelHost::name>,
#define STRING_SERVICE(name, arguments, results, effects, doc)
#include "rsl/model/services.def"
};

}  // namespace

jit::ServiceFn find_service(std::string_view name) {
    return rsl::find_service(kServices, name);
}

}  // namespace kinora
