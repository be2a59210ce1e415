// tests/runtime/picture/light/closed_forms.h: shares of the half turn above a point of the plane
// z = 0 that shapes fill, weighed by the cosine (form factors). Irradiance is PI x radiance x
// share.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "runtime/base/math.h"

namespace kinora {

// Of a rectangle [0,x] x [0,y] at distance 1, parallel to the plane, its corner above the point
// (Howell, A catalog of radiation configuration factors, B-4).
inline double above_corner(double x, double y) {
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * kPi);
}

// Of the rectangle from `low` to `high` at that height.
inline double rectangle_share(dvec2 p, dvec2 low, dvec2 high, double height) {
    auto corner = [&](double x, double y) {
        return std::copysign(above_corner(std::abs(x - p.x) / height, std::abs(y - p.y) / height),
                             (x - p.x) * (y - p.y));
    };
    return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) +
           corner(low.x, low.y);
}

// Of a disc parallel to the plane, above the origin (Howell, B-13).
inline double disc_share(dvec2 p, double radius, double height) {
    const double a2 = glm::dot(p, p), r2 = radius * radius, h2 = height * height;
    const double sum = h2 + a2 + r2;
    return 0.5 * (1 - (h2 + a2 - r2) / std::sqrt(sum * sum - 4 * r2 * a2));
}

// Of a sphere that the horizon does not cut.
inline double sphere_share(dvec2 p, double radius, double height) {
    const double far2 = height * height + glm::dot(p, p);
    return radius * radius / far2 * height / std::sqrt(far2);
}

// Of a flat polygon that is seen from its front, wholly above the plane: the sum over its edges of
// the angle times the height of the edge's normal (J. Lambert 1760).
inline double polygon_share(dvec3 p, std::span<const dvec3> corners) {
    double sum = 0;
    for (size_t k = 0; k < corners.size(); ++k) {
        const dvec3 a = corners[k] - p, b = corners[(k + 1) % corners.size()] - p;
        const dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0) sum -= std::atan2(sine, glm::dot(a, b)) * across.z / sine;
    }
    return sum / (2 * kPi);
}

}  // namespace kinora
