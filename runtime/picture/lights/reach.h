// runtime/picture/lights/reach.h: how far a light's kernel can send light at all.
#pragma once

#include <cstddef>
#include <limits>

#include "runtime/base/math.h"

namespace kinora {

// No light arrives outside the cone about the axis, nor farther than the range.
struct LightReach {
    dvec3 apex{0.0}, axis{0.0, 0.0, 1.0};  // axis of length 1, from the light
    double cosine = -1, sine = 0;          // of the cone's half angle; all around as it stands
    double range = std::numeric_limits<double>::infinity();
    bool black = false;                  // none is sent now
    void set_cone(double half_radians);  // and a little wider: kernels compute in floats
    bool bounded() const { return black || cosine > -1 || range < kEndless; }

    static constexpr double kEndless = std::numeric_limits<double>::infinity();
};

struct Sphere {
    dvec3 center{0.0};
    double radius = 0;
    dvec3 half{LightReach::kEndless};  // of a box about its points, with the same center
};

// About the box of these points, and that box.
Sphere sphere_about(const float* const P[3], size_t count);

// Whether light may arrive anywhere in the sphere and its box; true in doubt.
bool reaches(const LightReach& light, const Sphere& sphere);

}  // namespace kinora
