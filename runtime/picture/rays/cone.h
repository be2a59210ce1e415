// runtime/picture/rays/cone.h: directions within a cone.
#pragma once

#include <cstdint>

#include "runtime/base/math.h"

namespace kinora {

// The axes of a cone and the direction of sample k of n stratified ones in it.
struct Cone {
    vec3 x, y, z;  // orthonormal, z the axis
    float cosine;  // of the angle between axis and side
    bool by_cosine;
    Cone() = default;
    Cone(vec3 axis, float angle, bool cosine_weighted);
    vec3 direction(uint32_t k, uint32_t seed) const;
};

}  // namespace kinora
