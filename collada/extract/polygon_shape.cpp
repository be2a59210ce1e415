// collada/extract/polygon_shape.cpp: Newell's normal and what the corners do about it.
#include "collada/extract/polygon_shape_p.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace kinora::collada {

namespace {

// Files hold about seven digits: corners off a line by less are on it.
constexpr double kFileDigits = 1e-7;
// A polygon bent by less than this part of its diameter shows no difference however it is cut.
constexpr double kFlat = 0.02;
// Corners that turn back by less (as a sine) are those of a straight edge.
constexpr double kStraight = 1e-3;

double cross2(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners seen along the axis nearest the normal.
void project(std::span<const dvec3> corners, const dvec3& normal, std::vector<dvec2>& points) {
    double dvec3::*u = &dvec3::x;
    double dvec3::*v = &dvec3::y;
    if (std::abs(normal.x) >= std::abs(normal.y) && std::abs(normal.x) >= std::abs(normal.z))
        u = &dvec3::y, v = &dvec3::z;
    else if (std::abs(normal.y) >= std::abs(normal.z))
        u = &dvec3::z, v = &dvec3::x;
    points.resize(corners.size());
    for (size_t i = 0; i < corners.size(); ++i)
        points[i] = {corners[i].*u - corners[0].*u, corners[i].*v - corners[0].*v};
}

// Edges that only touch, as where a hole is joined to its outline, do not cross.
bool edges_cross(std::span<const dvec2> p, double tolerance) {
    size_t n = p.size();
    auto side = [&](double area) { return area > tolerance ? 1 : area < -tolerance ? -1 : 0; };
    for (size_t i = 0; i + 2 < n; ++i)
        for (size_t k = i + 2; k < n && k < n - (i == 0); ++k) {
            dvec2 a = p[i], b = p[i + 1], c = p[k], d = p[k + 1 < n ? k + 1 : 0];
            if (side(cross2(a, b, c)) * side(cross2(a, b, d)) < 0 &&
                side(cross2(c, d, a)) * side(cross2(c, d, b)) < 0)
                return true;
        }
    return false;
}

}  // namespace

PolygonShape polygon_shape(std::span<const dvec3> corners) {
    constexpr size_t kAllPairs = 8;
    PolygonShape shape;
    const dvec3& origin = corners[0];  // differences keep far polygons exact
    size_t n = corners.size();
    dvec3 area(0.0), a = corners[1] - origin, sum = a;
    double diameter2 = glm::dot(a, a);
    for (size_t i = 2; i < n; ++i) {
        dvec3 b = corners[i] - origin;
        diameter2 = std::max(diameter2, glm::dot(b, b));
        area += glm::cross(a, b);
        sum += b;
        a = b;
    }
    // Of larger polygons the distance from one corner says enough.
    for (size_t i = 1; n <= kAllPairs && i < n; ++i)
        for (size_t k = i + 1; k < n; ++k) {
            dvec3 side = corners[k] - corners[i];
            diameter2 = std::max(diameter2, glm::dot(side, side));
        }
    double length2 = glm::dot(area, area);
    if (!(length2 > kFileDigits * kFileDigits * diameter2 * diameter2)) {
        shape.empty = true;
        return shape;
    }
    if (n == 3) return shape;
    dvec3 normal = area / std::sqrt(length2);
    dvec3 center = sum / double(n), in = origin - corners[n - 1];
    for (size_t i = 0; i < n; ++i) {
        double height = glm::dot(corners[i] - origin - center, normal);
        shape.deviation = std::max(shape.deviation, std::abs(height));
        dvec3 out = corners[i + 1 < n ? i + 1 : 0] - corners[i];
        double turn = glm::dot(glm::cross(in, out), normal);
        if (turn < 0 && turn * turn > kStraight * kStraight * glm::dot(in, in) * glm::dot(out, out))
            shape.concave = true;
        in = out;
    }
    shape.deviation /= std::sqrt(diameter2);
    constexpr size_t kMostCorners = 256;  // the work is the square of it
    constexpr double kFlatEnough = 0.05;  // a folded polygon crosses only as it is seen
    if (n <= kMostCorners && shape.deviation < kFlatEnough) {
        thread_local std::vector<dvec2> points;
        project(corners, normal, points);
        shape.crossing = edges_cross(points, kFileDigits * diameter2);
    }
    shape.concave = shape.concave && !shape.crossing;
    return shape;
}

void PolygonStatistics::add(std::span<const dvec3> corners) {
    PolygonShape shape = polygon_shape(corners);
    ++polygons;
    empty += shape.empty;
    concave += shape.concave;
    crossing += shape.crossing;
    bent += shape.deviation > kFlat;
    worst_deviation = std::max(worst_deviation, shape.deviation);
}

}  // namespace kinora::collada
