// runtime/scene/images/map_light.h: light of environment maps along directions, and directions by
// that light.
#pragma once

#include <cstdint>
#include <span>

#include "jit/ir/kernel.h"
#include "runtime/base/math.h"

namespace kinora {

class MapDistribution;
class TextureStore;

// Along directions in the map's own space. Looks are as wide as a texel: wider ones would see light
// from outside a cone, or light that other directions count.
void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, vec3* light);

// Directions by the light of a map, made when it is first asked for. Null for the name "".
const MapDistribution* distribution_of(TextureStore& store, int32_t map);

// The services "maplight", "mapdensity" and "mapdirection" (rsl/model/services.def). A map of the
// name "" is white. Where texels are no numbers, or below 0, a map sends nothing.
void lookup_map_light(const jit::ServiceCall& call, TextureStore& store);
void lookup_map_density(const jit::ServiceCall& call, TextureStore& store);
void lookup_map_direction(const jit::ServiceCall& call, TextureStore& store);

}  // namespace kinora
