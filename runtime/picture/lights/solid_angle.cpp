// runtime/picture/lights/solid_angle.cpp: directions to rectangles and spheres.
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
// Triangles may lie off a rectangle's plane by the tolerance of shapes.
constexpr double kAboutPlane = 1e-3;

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

}  // namespace

SolidAngle::SolidAngle(const LampShape& shape, dvec3 P) {
    if (shape.kind == LampShape::Kind::Rectangle) see_rectangle(shape, P);
    if (shape.kind == LampShape::Kind::Sphere) see_sphere(shape, P);
}

SolidAngle::Way SolidAngle::sample(double u, double v) const {
    return sphere_ ? to_sphere(u, v) : to_rectangle(u, v);
}

// ---- rectangles ---------------------------------------------------------------------------------

void SolidAngle::see_rectangle(const LampShape& shape, dvec3 P) {
    const dvec3 to_corner = shape.corner - P;
    std::copy_n(shape.axis, 3, axis_);
    x_[0] = glm::dot(to_corner, axis_[0]);
    y_[0] = glm::dot(to_corner, axis_[1]);
    x_[1] = x_[0] + shape.side[0];
    y_[1] = y_[0] + shape.side[1];
    z_ = glm::dot(to_corner, axis_[2]);
    if (z_ < 0) axis_[2] = -axis_[2];
    z_ = std::abs(z_);
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

// The part u of the solid angle lies before the plane x; on the line there, heights of the sphere
// are even.
SolidAngle::Way SolidAngle::to_rectangle(double u, double v) const {
    const SineCosine part = sine_cosine(u * angle_ + start_);
    const double f = (part.cosine * first_ - last_) / part.sine;
    const double out = 1 / std::sqrt(f * f + first_ * first_);
    const double cosine = std::min(out, 1.0), left2 = 1 - cosine * cosine;
    const double reach = left2 > 0 ? cosine * z_ / std::sqrt(left2) : x_[1] - x_[0];
    const double x = std::clamp(f > 0 ? reach : -reach, x_[0], x_[1]);
    const double line2 = x * x + z_ * z_;
    const double low = y_[0] / std::sqrt(line2 + y_[0] * y_[0]),
                 high = y_[1] / std::sqrt(line2 + y_[1] * y_[1]);
    const double height = low + v * (high - low), rest2 = 1 - height * height;
    const double y = rest2 > 0 ? height * std::sqrt(line2 / rest2) : y_[1];
    return {x * axis_[0] + std::clamp(y, y_[0], y_[1]) * axis_[1] + z_ * axis_[2], 1 - kAboutPlane,
            1 + kAboutPlane};
}

// ---- spheres ------------------------------------------------------------------------------------

void SolidAngle::see_sphere(const LampShape& shape, dvec3 P) {
    sphere_ = true;
    radius_ = shape.radius;
    const dvec3 to_center = shape.center - P;
    distance_ = glm::length(to_center);
    if (!(distance_ > kOutside * radius_)) return;
    const double sine2 = radius_ * radius_ / (distance_ * distance_);
    if (!(sine2 > kLeastSine2)) return;
    // J. Duff and others, Building an Orthonormal Basis, Revisited, 2017.
    const dvec3 z = to_center / distance_;
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    axis_[0] = dvec3(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    axis_[1] = dvec3(b, sign + z.y * z.y * a, -z.y);
    axis_[2] = z;
    opening_ = sine2 / (1 + std::sqrt(1 - sine2));
    density_ = 1 / (2 * kPi * opening_);
}

SolidAngle::Way SolidAngle::to_sphere(double u, double v) const {
    const double down = u * opening_, out = std::sqrt(down * (2 - down));
    const SineCosine turn = sine_cosine(2 * kPi * v);
    const dvec3 direction =
        (1 - down) * axis_[2] + out * (turn.cosine * axis_[0] + turn.sine * axis_[1]);
    constexpr double kSlack = 1e-3;
    const double slack = kSlack * radius_;
    return {direction, std::max(distance_ - radius_ - slack, 0.5 * (distance_ - radius_)),
            distance_ + radius_ + slack};
}

}  // namespace kinora
