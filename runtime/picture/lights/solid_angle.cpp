// runtime/picture/lights/solid_angle.cpp: the solid angles of rectangles and spheres.
#include "runtime/picture/lights/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

// Below, the angles' differences have fewer than nine digits.
constexpr double kLeastAngle = 1e-6;
// Of the longer side: the distance of a plane below which squares lose the places of samples.
constexpr double kLeastHeight = 1e-6;
// Samples of a sphere leave points in its space, whose coordinates are floats.
constexpr double kLeastSine2 = 1e-10;
constexpr double kOutside = 1 + 1e-4;  // of the radius: the distance of points outside
constexpr double kSlack = 1e-3;        // of the radius: about what a ray may meet of a sphere

// 1 - the cosine of a cone's half angle.
double opening_of(double sine2) {
    return sine2 / (1 + std::sqrt(1 - sine2));
}

}  // namespace

void see_rectangles(const LampShape& shape, std::span<const dvec3> points, RectangleLanes& lanes,
                    double (&density)[kAngleLanes]) {
    bool stands_off[kAngleLanes];
    for (size_t i = 0; i < kAngleLanes; ++i) {
        const dvec3 to_corner = shape.corner - points[std::min(i, points.size() - 1)];
        lanes.x[0][i] = glm::dot(to_corner, shape.axis[0]);
        lanes.y[0][i] = glm::dot(to_corner, shape.axis[1]);
        lanes.x[1][i] = lanes.x[0][i] + shape.side[0];
        lanes.y[1][i] = lanes.y[0][i] + shape.side[1];
        const double z = std::abs(glm::dot(to_corner, shape.axis[2]));
        stands_off[i] = z > kLeastHeight * std::max(shape.side[0], shape.side[1]);
        lanes.z[i] = stands_off[i] ? z : 1.0;
    }
    angle_kernels().see_rectangles(lanes);
    for (size_t i = 0; i < kAngleLanes; ++i)
        density[i] = stands_off[i] && lanes.angle[i] > kLeastAngle ? 1 / lanes.angle[i] : 0.0;
}

SolidAngle::SolidAngle(const LampShape& shape, dvec3 P) {
    if (shape.kind == LampShape::Kind::Rectangle) {
        double density[kAngleLanes];
        see_rectangles(shape, {&P, 1}, rectangle_, density);
        density_ = density[0];
    }
    if (shape.kind == LampShape::Kind::Sphere) see_sphere(shape, P);
}

void SolidAngle::put(RectangleLanes& lanes, size_t lane) const {
    for (int k = 0; k < 2; ++k) {
        lanes.x[k][lane] = rectangle_.x[k][0];
        lanes.y[k][lane] = rectangle_.y[k][0];
    }
    lanes.z[lane] = rectangle_.z[0];
    lanes.first[lane] = rectangle_.first[0];
    lanes.last[lane] = rectangle_.last[0];
    lanes.angle[lane] = rectangle_.angle[0];
    lanes.start[lane] = rectangle_.start[0];
}

void SolidAngle::see_sphere(const LampShape& shape, dvec3 P) {
    const double radius = shape.radius;
    const dvec3 to_center = shape.center - P;
    const double distance = glm::length(to_center);
    if (!(distance > kOutside * radius)) return;
    const double sine2 = radius * radius / (distance * distance);
    if (!(sine2 > kLeastSine2)) return;
    // J. Duff and others, Building an Orthonormal Basis, Revisited, 2017.
    const dvec3 z = to_center / distance;
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    axis_[0] = dvec3(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    axis_[1] = dvec3(b, sign + z.y * z.y * a, -z.y);
    axis_[2] = z;
    opening_ = opening_of(sine2);
    density_ = 1 / (2 * kPi * opening_);
    sure_ = opening_of(sine2 * shape.inner * shape.inner / (radius * radius)) / opening_;
    near_ = std::max(distance - (1 + kSlack) * radius, 0.5 * (distance - radius));
    far_ = distance + (1 + kSlack) * radius;
}

void SolidAngle::put(SphereLanes& lanes, size_t lane) const {
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 3; ++k) lanes.axis[a][k][lane] = axis_[a][k];
    lanes.opening[lane] = opening_;
}

}  // namespace kinora
