// runtime/scene/ri/state/balls.cpp: where primitives lie, before they are made.
#include <algorithm>
#include <cmath>

#include "runtime/scene/ri/state/primitives.h"

namespace kinora::ri {
namespace {

// About the z axis.
struct Barrel {
    double radius, low, high;
};

std::optional<Barrel> barrel_of(const Call& call) {
    auto number = [&](size_t i) { return double(call.arguments[i].real()); };
    const auto size = [&](size_t i) { return std::abs(number(i)); };
    switch (call.request) {
        case Request::Sphere:
            return Barrel{size(0), -size(0), size(0)};
        case Request::Cone:
            return Barrel{size(1), 0, number(0)};
        case Request::Cylinder:
        case Request::Paraboloid:
            return Barrel{size(0), number(1), number(2)};
        case Request::Hyperboloid:
            return Barrel{
                std::max(std::hypot(number(0), number(1)), std::hypot(number(3), number(4))),
                number(2), number(5)};
        case Request::Disk:
            return Barrel{size(1), number(0), number(0)};
        case Request::Torus:
            return Barrel{size(0) + size(1), -size(1), size(1)};
        default:
            return std::nullopt;
    }
}

// Whether what the basis blends lies among its points, or nearly.
bool stays_among_points(const Basis& basis) {
    constexpr double kNearly = -0.13;  // catmull-rom
    for (double t : {0.25, 0.5, 0.75}) {
        const dvec4 weights = glm::transpose(basis.matrix) * dvec4(t * t * t, t * t, t, 1);
        for (int i = 0; i < 4; ++i)
            if (!(weights[i] > kNearly)) return false;
    }
    return true;
}

}  // namespace

std::optional<Ball> ball_of(const Call& call, const Attributes& attributes) {
    if (auto barrel = barrel_of(call)) {
        const double half = std::abs(barrel->high - barrel->low) / 2;
        return Ball{dvec3(0, 0, (barrel->low + barrel->high) / 2),
                    std::hypot(barrel->radius, half)};
    }
    const bool patch = call.request == Request::Patch || call.request == Request::PatchMesh;
    if (patch && call.arguments[0].string() == "bicubic" &&
        !(stays_among_points(attributes.u) && stays_among_points(attributes.v)))
        return std::nullopt;
    const std::vector<dvec3> points = points_of(call);
    if (points.empty()) return std::nullopt;
    dvec3 low = points[0], high = points[0];
    for (const dvec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
    return Ball{(low + high) / 2.0, glm::length(high - low) / 2};
}

}  // namespace kinora::ri
