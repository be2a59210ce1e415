// runtime/scene/tessellate/steady_scale.cpp: finenesses that many places share.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/tessellate/tessellate.h"

namespace kinora {

std::optional<PictureScale> steady_scale(const PictureScale& scale, dvec3 center, double radius) {
    constexpr double kAlike = 1.5;  // of sizes along the axes
    constexpr double kFar = 3;      // radii away
    constexpr double kStepsAnOctave = 2;
    double least = 1e300, size = 0;
    for (int c = 0; c < 3; ++c) {
        const double length = glm::length(dvec3(scale.to_camera[c]));
        least = std::min(least, length), size = std::max(size, length);
    }
    if (!(scale.pixels > 0) || !(size <= kAlike * least)) return std::nullopt;
    double pixels = scale.pixels * size;
    if (!scale.orthographic) {
        const dvec3 at(scale.to_camera * dvec4(center, 1));
        const double reach = size * radius, near = at.z - reach;
        if (!(near > scale.near) || !(at.z >= kFar * reach)) return std::nullopt;
        if (std::hypot(at.x, at.y) > kWidestView * at.z) return std::nullopt;
        pixels *= (glm::length(at) + reach) / (near * near);
    }
    if (!std::isfinite(pixels)) return std::nullopt;
    PictureScale made;
    made.orthographic = true;
    made.pixels = std::exp2(std::ceil(kStepsAnOctave * std::log2(pixels)) / kStepsAnOctave);
    return made;
}

}  // namespace kinora
