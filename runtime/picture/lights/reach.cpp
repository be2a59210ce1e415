// runtime/picture/lights/reach.cpp: cones and ranges against spheres.
#include "runtime/picture/lights/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/picture/lights/kernels.h"

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
    return {0.5 * (low + high), 0.5 * glm::length(high - low), 0.5 * (high - low)};
}

void LightReach::set_cone(double half_radians) {
    const double wider = std::min(half_radians + kMargin, kPi);
    cosine = std::cos(wider);
    sine = std::sin(wider);
}

// In the plane of the axis and the sphere's middle: how far the middle lies outside of the cone's
// side, which begins at the apex.
bool reaches(const LightReach& light, const Sphere& sphere) {
    if (light.black) return false;
    const dvec3 way = sphere.center - light.apex;
    const double distance = glm::length(way);
    const double margin = kMargin * (distance + glm::length(light.apex));
    // A cone of less than a half space may look away from a box that is around its apex's height.
    const double ahead = glm::dot(way, light.axis) + glm::dot(glm::abs(light.axis), sphere.half);
    if (light.cosine > 0 && ahead < -margin) return false;
    const double radius = sphere.radius + margin;
    if (!(distance > radius)) return true;
    if (distance - radius > light.range) return false;
    const double along = glm::dot(way, light.axis);
    const double across = std::sqrt(std::max(distance * distance - along * along, 0.0));
    if (along >= light.cosine * distance) return true;  // it lies within
    return across * light.cosine - along * light.sine <= radius &&
           along * light.cosine + across * light.sine >= 0;
}

}  // namespace kinora
