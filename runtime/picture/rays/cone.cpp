// runtime/picture/rays/cone.cpp: a cone's axes.
#include "runtime/picture/rays/cone.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/picture/rays/ray_kernels.h"

namespace kinora {

// An orthonormal basis without a branch: Duff et al., Building an Orthonormal Basis, Revisited,
// JCGT 2017.
Cone::Cone(vec3 axis, float angle, bool cosine_weighted) : by_cosine(cosine_weighted) {
    z = axis / glm::length(axis);
    float sign = std::copysign(1.0f, z.z);
    float a = -1.0f / (sign + z.z), b = z.x * z.y * a;
    x = vec3(1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x);
    y = vec3(b, sign + z.y * z.y * a, -z.y);
    float half_turn = by_cosine ? 1.57079633f : 3.14159265f;
    cosine = std::cos(std::clamp(angle, 0.0f, half_turn));
}

vec3 Cone::direction(uint32_t k, uint32_t seed) const {
    float dir[3][kSixteen];
    ray_kernels().directions(*this, k, seed, dir);
    return {dir[0][0], dir[1][0], dir[2][0]};
}

}  // namespace kinora
