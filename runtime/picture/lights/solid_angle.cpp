// runtime/picture/lights/solid_angle.cpp: the solid angles of rectangles and spheres.
//
// C. Urena, M. Fajardo, A. King, An Area-Preserving Parametrization for Spherical Rectangles, 2013.
// The angles between the planes through the point and the sides come from sines and cosines
// together, so that small ones keep their digits.
#include "runtime/picture/lights/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/picture/lights/angles.h"

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

// The normal of the plane through the point and a side: along z, and along the side's own axis.
struct Normal {
    Normal(double side, double z) {
        const double length = std::sqrt(side * side + z * z);
        along_z = side / length;
        across = z / length;
    }
    Normal operator-() const {
        Normal turned = *this;
        turned.along_z = -along_z;
        return turned;
    }
    double along_z, across;
};

// The inner angle at a corner, where the planes of two such normals meet.
double corner_angle(const Normal& a, const Normal& b) {
    const double sine2 = a.across * a.across + a.along_z * a.along_z * b.across * b.across;
    return angle_of(std::sqrt(sine2), -a.along_z * b.along_z);
}

// 1 - the cosine of a cone's half angle.
double opening_of(double sine2) {
    return sine2 / (1 + std::sqrt(1 - sine2));
}

}  // namespace

SolidAngle::SolidAngle(const LampShape& shape, dvec3 P) {
    if (shape.kind == LampShape::Kind::Rectangle) see_rectangle(shape, P);
    if (shape.kind == LampShape::Kind::Sphere) see_sphere(shape, P);
}

void SolidAngle::see_rectangle(const LampShape& shape, dvec3 P) {
    const dvec3 to_corner = shape.corner - P;
    x_[0] = glm::dot(to_corner, shape.axis[0]);
    y_[0] = glm::dot(to_corner, shape.axis[1]);
    x_[1] = x_[0] + shape.side[0];
    y_[1] = y_[0] + shape.side[1];
    z_ = std::abs(glm::dot(to_corner, shape.axis[2]));
    if (!(z_ > kLeastHeight * std::max(shape.side[0], shape.side[1]))) return;
    // The normals look outwards, as -y, x, y and -x do.
    const Normal below = -Normal(y_[0], z_), above(y_[1], z_), left = -Normal(x_[0], z_),
                 right(x_[1], z_);
    first_ = below.along_z;
    last_ = above.along_z;
    start_ = 2 * kPi - corner_angle(above, left) - corner_angle(left, below);
    angle_ = corner_angle(below, right) + corner_angle(right, above) - start_;
    if (angle_ > kLeastAngle) density_ = 1 / angle_;
}

void SolidAngle::put(RectangleLanes& lanes, size_t lane) const {
    for (int k = 0; k < 2; ++k) {
        lanes.x[k][lane] = x_[k];
        lanes.y[k][lane] = y_[k];
    }
    lanes.z[lane] = z_;
    lanes.first[lane] = first_;
    lanes.last[lane] = last_;
    lanes.angle[lane] = angle_;
    lanes.start[lane] = start_;
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
