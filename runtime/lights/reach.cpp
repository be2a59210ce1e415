// runtime/lights/reach.cpp: cones and ranges against spheres.
#include "runtime/lights/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/lights/kernels.h"

namespace kinora {

namespace {

constexpr double kMargin = 1e-4;  // of angles and lengths: kernels compute in floats

}  // namespace

Sphere sphere_about(const float* const P[3], size_t count) {
    dvec3 low, high;
    for (int k = 0; k < 3; ++k) {
        float least, most;
        light_kernels().bounds(P[k], count, least, most);
        low[k] = least;
        high[k] = most;
    }
    return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

// The angle between the axis and the sphere's middle, less that under which the apex sees the
// sphere's radius.
bool reaches(const LightReach& light, const Sphere& sphere) {
    const dvec3 way = sphere.center - light.apex;
    const double distance = glm::length(way);
    const double radius = sphere.radius + kMargin * (distance + glm::length(light.apex));
    if (!(distance > radius)) return true;
    if (distance - radius > light.range) return false;
    const double half = light.half_angle + std::asin(radius / distance) + kMargin;
    return half >= kPi || glm::dot(way, light.axis) >= std::cos(half) * distance;
}

}  // namespace kinora
