// runtime/picture/shading/rays/map_light.cpp: directions to colors of maps.
#include "runtime/picture/shading/rays/map_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "jit/ir/kernel_call.h"
#include "runtime/scene/images/texture.h"

namespace kinora {

void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, float width,
                  vec3* light) {
    alignas(64) float args[13 * jit::kMaxLanes] = {}, results[4 * jit::kMaxLanes];
    for (size_t begin = 0; begin < directions.size(); begin += jit::kMaxLanes) {
        size_t count = std::min(directions.size() - begin, size_t(jit::kMaxLanes));
        for (size_t i = 0; i < count; ++i) {
            vec3 d = directions[begin + i];
            // Any two directions across d span the footprint.
            vec3 side = std::abs(d.x) > 0.5f ? vec3(-d.y, d.x, 0) : vec3(0, -d.z, d.y);
            side *= width / glm::length(side);
            vec3 up = glm::cross(d, side);
            args[i] = jit::float_of(map);
            for (int k = 0; k < 3; ++k) {
                args[(2 + k) * jit::kMaxLanes + int(i)] = d[k];
                args[(5 + k) * jit::kMaxLanes + int(i)] = side[k];
                args[(8 + k) * jit::kMaxLanes + int(i)] = up[k];
            }
        }
        lookup_environment({nullptr, args, results, (1u << count) - 1, 0, jit::kMaxLanes}, store);
        for (size_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) light[begin + i][k] = results[k * jit::kMaxLanes + int(i)];
    }
}

}  // namespace kinora
