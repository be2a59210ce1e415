// runtime/scene/build/framing.cpp: the nearest eye that has given points in its picture.
#include "runtime/scene/build/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr double kLeastRoom = 0.1;  // between the eye and the nearest point, of the points' depth

}  // namespace

Framing::Framing(const ViewAxes& axes, double half_width, double half_height) : axes_(axes) {
    sides_[0].window = kFramedShare * half_width;
    sides_[1].window = kFramedShare * half_height;
    for (Side& side : sides_) {
        side.plus.fill(-1e300);
        side.minus.fill(-1e300);
    }
}

void Framing::add(dvec3 p) {
    double a[2] = {glm::dot(p, axes_.right), glm::dot(p, axes_.up)}, c = glm::dot(p, axes_.back);
    double swing = 0, radius = 0, rise = 0, tilt = 0;
    if (axis_) {
        double height = glm::dot(p, *axis_);
        radius = glm::length(p - height * *axis_);
        rise = glm::dot(*axis_, axes_.back);  // sine and cosine of the view's elevation
        tilt = std::sqrt(std::max(0.0, 1 - rise * rise));
        a[0] = 0;
        a[1] = height * glm::dot(*axis_, axes_.up);
        c = height * rise;
        swing = radius * tilt;
    }
    nearest_ = std::max(nearest_, c + swing);
    farthest_ = std::min(farthest_, c - swing);
    for (size_t s = 0; s < 2; ++s)
        for (size_t k = 0; k <= kWindows; ++k) {
            double t = sides_[s].step(k);
            double plus = 0, minus = 0;
            if (radius > 0) {  // the largest a + t c on the circle, by its angle
                plus = radius * (s == 0 ? std::hypot(1.0, t * tilt) : std::abs(t * tilt - rise));
                minus = radius * (s == 0 ? std::hypot(1.0, t * tilt) : std::abs(t * tilt + rise));
            }
            sides_[s].plus[k] = std::max(sides_[s].plus[k], a[s] + t * c + plus);
            sides_[s].minus[k] = std::max(sides_[s].minus[k], -a[s] + t * c + minus);
        }
}

double Framing::half_extent(const Side& side, size_t k) const {
    double plus = side.plus[k], minus = side.minus[k];
    return centred_ ? std::max(plus, minus) : 0.5 * (plus + minus);
}

// Where the eye at that distance has as much room on one side of the points as on the other.
double Framing::Side::middle(double distance) const {
    size_t k = kWindows;
    while (k > 1 && extent(k - 1) <= step(k - 1) * distance) --k;
    // Between k - 1 and k the largest values are taken for lines, which they do not exceed.
    double from = extent(k - 1) - step(k - 1) * distance;  // > 0 unless k = 1
    double to = extent(k) - step(k) * distance;            // <= 0
    double share = from > to ? std::clamp(from / (from - to), 0.0, 1.0) : 1.0;
    auto between = [&](const auto& values) {
        return values[k - 1] + share * (values[k] - values[k - 1]);
    };
    return 0.5 * (between(plus) - between(minus));
}

dvec3 Framing::world_point(double across, double up, double depth) const {
    return across * axes_.right + up * axes_.up + depth * axes_.back;
}

dvec3 Framing::perspective_eye() const {
    double depth = nearest_ - farthest_;
    double distance = nearest_ + kLeastRoom * depth;
    for (const Side& side : sides_)
        distance = std::max(distance, half_extent(side, kWindows) / side.window);
    if (!(distance > nearest_)) distance = nearest_ + 1;  // all in one point
    if (centred_) return world_point(0, 0, distance);
    return world_point(sides_[0].middle(distance), sides_[1].middle(distance), distance);
}

Framing::Parallel Framing::parallel_eye() const {
    double depth = nearest_ - farthest_, size = 0;
    for (const Side& side : sides_) size = std::max(size, half_extent(side, 0) / side.window);
    if (!(size > 0)) size = depth > 0 ? depth : 1;
    double half_height = size * sides_[1].window / kFramedShare;
    double distance = nearest_ + std::max(depth, half_height);
    if (centred_) return {world_point(0, 0, distance), half_height};
    auto middle = [](const Side& side) { return 0.5 * (side.plus[0] - side.minus[0]); };
    return {world_point(middle(sides_[0]), middle(sides_[1]), distance), half_height};
}

}  // namespace kinora
