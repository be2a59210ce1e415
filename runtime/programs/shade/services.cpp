// runtime/programs/shade/services.cpp: the world around a patch: two lights, textures,
// nothing for rays to meet.
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "rsl/model/service_table.h"
#include "runtime/images/texture.h"
#include "runtime/programs/shade/kernel.h"
#include "runtime/shading/print.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;
constexpr float kMissDistance = 1e30f;

void fill(const jit::ServiceCall& call, int result, float value) {
    for (int i = 0; i < kLanes; ++i) call.results[result * kLanes + i] = value;
}

// The lights are the same everywhere: set 0.
void lights(const jit::ServiceCall& call) {
    fill(call, 0, jit::float_of(0));
}
void shadow(const jit::ServiceCall& call) {
    const Patch& patch = *static_cast<const Patch*>(call.grid);
    lookup_shadow(call, glm::inverse(patch.current_from_space("world")), *patch.textures);
}
void texture(const jit::ServiceCall& call) {
    lookup_texture(call, *static_cast<const Patch*>(call.grid)->textures);
}
void environment(const jit::ServiceCall& call) {
    lookup_environment(call, *static_cast<const Patch*>(call.grid)->textures);
}
void texture_info(const jit::ServiceCall& call) {
    lookup_texture_info(call, *static_cast<const Patch*>(call.grid)->textures);
}
void trace(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill(call, k, 0.0f);
    fill(call, 3, kMissDistance);
}
void transmission(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill(call, k, 1.0f);
}

// Without a scene gather has no rays to loop over: set 1 is empty.
void gather(const jit::ServiceCall& call) {
    fill(call, 0, jit::float_of(1));
}

void transform(const jit::ServiceCall& call) {
    const Patch& patch = *static_cast<const Patch*>(call.grid);
    for (int i = 0; i < kLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        dmat4 to = patch.current_from_space(rsl::interned(jit::bits_of(call.args[i])));
        dmat4 from = glm::inverse(to);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                int k = row * 4 + column;
                call.results[k * kLanes + i] = float(to[column][row]);
                call.results[(12 + k) * kLanes + i] = float(from[column][row]);
            }
    }
}

void print(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane)
        if (call.mask >> lane & 1) std::fputs(print_text(call, lane).c_str(), stdout);
}

// Nothing is near, nothing is known.
constexpr rsl::ServiceTable kServices = {
    .lights = lights,
    .texture = texture,
    .environment = environment,
    .shadow = shadow,
    .textureinfo = texture_info,
    .trace = trace,
    .transmission = transmission,
    .occlusion = rsl::answer_zeros<rsl::Service::occlusion>,
    .indirectdiffuse = rsl::answer_zeros<rsl::Service::indirectdiffuse>,
    .gather = gather,
    .query = rsl::answer_zeros<rsl::Service::query>,
    .bake3d = rsl::answer_zeros<rsl::Service::bake3d>,
    .texture3d = rsl::answer_zeros<rsl::Service::texture3d>,
    .photons = rsl::answer_zeros<rsl::Service::photons>,
    .transform = transform,
    .print = print,
};

}  // namespace

const rsl::ServiceTable& shade_services() {
    return kServices;
}

// As in a scene without lights (docs/lights.md#defaults): a distant light from over the camera's
// left shoulder, and ambient 0.15.
std::vector<ShadeLight> shade_lights() {
    return {{rsl::kLightAmbient, vec3(0), vec3(0.15f)},
            {rsl::kLightSolar, glm::normalize(vec3(-0.5f, 0.7f, -1.0f)), vec3(1)}};
}

}  // namespace kinora
