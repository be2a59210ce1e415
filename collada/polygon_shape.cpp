// collada/polygon_shape.cpp: Newell's normal and what the corners do about it.
#include "collada/polygon_shape_p.h"

#include <algorithm>
#include <cmath>

namespace kinora::collada {

namespace {

dvec3 cross3(const dvec3& a, const dvec3& b) {
    return dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
double dot3(const dvec3& a, const dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Files hold about seven digits: corners off a line by less are on it.
constexpr double kFileDigits = 1e-7;
// A polygon bent by less than this part of its diameter shows no difference however it is cut.
constexpr double kFlat = 0.01;
// Corners that turn back by less (as a sine) are those of a straight edge.
constexpr double kStraight = 1e-3;

}  // namespace

PolygonShape polygon_shape(std::span<const dvec3> corners) {
    PolygonShape shape;
    const dvec3& origin = corners[0];  // differences keep far polygons exact
    size_t n = corners.size();
    dvec3 area(0.0);
    double diameter2 = 0;
    for (size_t i = 1; i < n; ++i) {
        dvec3 a = corners[i] - origin;
        diameter2 = std::max(diameter2, dot3(a, a));
        if (i + 1 < n) area += cross3(a, corners[i + 1] - origin);
    }
    if (n == 3) {
        dvec3 side = corners[2] - corners[1];
        diameter2 = std::max(diameter2, dot3(side, side));
    }
    double length2 = dot3(area, area);
    if (!(length2 > kFileDigits * kFileDigits * diameter2 * diameter2)) {
        shape.empty = true;
        return shape;
    }
    if (n == 3) return shape;
    dvec3 normal = area / std::sqrt(length2);
    dvec3 center(0.0);
    for (const dvec3& c : corners) center += (c - origin) / double(n);
    for (size_t i = 0; i < n; ++i) {
        dvec3 a = corners[i] - origin;
        shape.deviation = std::max(shape.deviation, std::abs(dot3(a - center, normal)));
        dvec3 in = corners[i] - corners[(i + n - 1) % n], out = corners[(i + 1) % n] - corners[i];
        double turn = dot3(cross3(in, out), normal);
        if (turn < 0 && turn * turn > kStraight * kStraight * dot3(in, in) * dot3(out, out))
            shape.concave = true;
    }
    shape.deviation /= std::sqrt(diameter2);
    return shape;
}

void PolygonStatistics::add(std::span<const dvec3> corners) {
    PolygonShape shape = polygon_shape(corners);
    ++polygons;
    empty += shape.empty;
    concave += shape.concave;
    bent += shape.deviation > kFlat;
    worst_deviation = std::max(worst_deviation, shape.deviation);
}

}  // namespace kinora::collada
