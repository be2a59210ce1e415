// runtime/picture/lights/lamp.h: what a light sends from one place, in closed form: all that a
// choice among many lights needs to know of each.
#pragma once

#include <limits>
#include <optional>

#include "runtime/base/math.h"

namespace kinora {

struct Pose;
struct SceneNodes;
struct ShaderInstance;

// In current space. At the distance d it sends strength / (fall[0] + fall[1] d + fall[2] d^2).
struct Lamp {
    vec3 position{0.0f};
    float strength = 0;  // of its color the largest component
    float fall[3] = {1, 0, 0};
    float range = std::numeric_limits<float>::infinity();  // nothing arrives beyond
    // Of a cone: nothing arrives outside of `edge`, all within `inner`; cosines of angles to the
    // axis. Within, the light is the cosine to the power `exponent`.
    vec3 axis{0.0f, 0.0f, 1.0f};
    float edge = -1, inner = -1, exponent = 0;
    bool operator==(const Lamp&) const = default;
};

// The lamp that a light is in a pose. Nothing, where no row of lamp.cpp knows its shader, or where
// its numbers make no sense.
std::optional<Lamp> lamp_of(const SceneNodes& nodes, const Pose& pose, const ShaderInstance& look);

}  // namespace kinora
