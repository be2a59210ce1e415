// runtime/texture.cpp: texture lookups for shaders.
#include "runtime/texture.h"

#include <cmath>

namespace kinora {

namespace {

void checks(const jit::ServiceCall& call, int s_argument) {
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        float s = call.args[s_argument * jit::kMaxLanes + i];
        float t = call.args[(s_argument + 1) * jit::kMaxLanes + i];
        bool on = (int(std::floor(s * 8)) + int(std::floor(t * 8))) & 1;
        const float color[4] = {on ? 1.0f : 0.0f, 0.0f, on ? 1.0f : 0.0f, 1.0f};
        for (int k = 0; k < 4; ++k) call.results[k * jit::kMaxLanes + i] = color[k];
    }
}

}  // namespace

void lookup_texture(const jit::ServiceCall& call) { checks(call, 2); }
void lookup_environment(const jit::ServiceCall& call) { checks(call, 2); }

}  // namespace kinora
