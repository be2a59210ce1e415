// runtime/scene/build/core.h: where most of some points lie together.
#pragma once

#include <limits>
#include <span>

#include "runtime/base/math.h"

namespace kinora {

// A ball about the median. One of endless reach holds all points.
struct Core {
    dvec3 middle{0.0};
    double reach = std::numeric_limits<double>::infinity();
};

// All but a few of the points; what is further away than those is stray.
inline constexpr double kCoreShare = 0.98;

// The ball around that share of the points, somewhat larger.
Core core_of(std::span<const dvec3> points, double share = kCoreShare);

}  // namespace kinora
