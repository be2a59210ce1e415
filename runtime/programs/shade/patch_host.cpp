// runtime/programs/shade/patch_host.cpp: what kernels hear on a patch.
#include "runtime/programs/shade/patch_host.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace kinora {

namespace {

constexpr float kMissDistance = 1e30f;

void fill(const jit::ServiceCall& call, int result, float value) {
    std::fill_n(call.results + result * jit::kMaxLanes, jit::kMaxLanes, value);
}

}  // namespace

dmat4 PatchHost::current_from_space(std::string_view name, size_t) const {
    return patch_.current_from_space(name);
}
dmat4 PatchHost::world_from_current() const {
    return glm::inverse(patch_.current_from_space("world"));
}
void PatchHost::print(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane)
        if (call.mask >> lane & 1) prints_.add(call, lane);
}
// The lights are the same everywhere.
void PatchHost::lights(const jit::ServiceCall& call) {
    fill(call, 0, jit::float_of(kPatchLights));
}
void PatchHost::trace(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill(call, k, 0.0f);
    fill(call, 3, kMissDistance);
}
void PatchHost::transmission(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill(call, k, 1.0f);
}
void PatchHost::gather(const jit::ServiceCall& call) {
    fill(call, 0, jit::float_of(kNoRays));
}

// As in a scene without lights (docs/lights.md#defaults): a distant light from over the camera's
// left shoulder, and ambient 0.15.
std::vector<ShadeLight> shade_lights() {
    return {{rsl::kLightAmbient, vec3(0), vec3(0.15f)},
            {rsl::kLightSolar, glm::normalize(vec3(-0.5f, 0.7f, -1.0f)), vec3(1)}};
}

}  // namespace kinora
