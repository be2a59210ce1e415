// runtime/picture/shading/rays/map_light.cpp: directions to colors of maps.
#include "runtime/picture/shading/rays/map_light.h"

#include <algorithm>

#include "jit/ir/kernel_call.h"
#include "runtime/scene/images/texture.h"

namespace kinora {

void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, vec3* light) {
    alignas(64) float args[13 * jit::kMaxLanes] = {}, results[4 * jit::kMaxLanes];
    for (size_t begin = 0; begin < directions.size(); begin += jit::kMaxLanes) {
        size_t count = std::min(directions.size() - begin, size_t(jit::kMaxLanes));
        for (size_t i = 0; i < count; ++i) {
            args[i] = jit::float_of(map);
            for (int k = 0; k < 3; ++k)
                args[(2 + k) * jit::kMaxLanes + int(i)] = directions[begin + i][k];
        }
        lookup_environment({nullptr, args, results, (1u << count) - 1, 0, jit::kMaxLanes}, store);
        for (size_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) light[begin + i][k] = results[k * jit::kMaxLanes + int(i)];
    }
}

}  // namespace kinora
