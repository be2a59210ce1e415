// runtime/base/transform_matrix.cpp: translate, rotate, scale, matrix, lookat and skew.
#include "runtime/base/transform_matrix.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr double kLeastSine = 1e-9;  // between a view and its up

// What is right where up lies along the view: x, or -y where that is the view, as COLLADA's up_axis
// has them.
dvec3 right_of(dvec3 back) {
    dvec3 x = std::abs(back.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, -1, 0);
    return glm::normalize(x - glm::dot(x, back) * back);
}

}  // namespace

dmat4 translation_matrix(const double* v) {
    dmat4 m(1.0);
    m[3] = dvec4(v[0], v[1], v[2], 1.0);
    return m;
}

// Rodrigues' formula; the angle is reduced in double, so large ones keep their accuracy.
dmat4 rotation_matrix(const double* v) {
    dvec3 axis(v[0], v[1], v[2]);
    double length = glm::length(axis);
    if (!(length > 0)) return dmat4(1.0);
    axis /= length;
    double angle = radians(std::remainder(v[3], 360.0));
    double c = std::cos(angle), s = std::sin(angle);
    dmat4 m(1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            m[column][row] = (1 - c) * axis[column] * axis[row] + (column == row ? c : 0.0);
    m[0][1] += s * axis.z;
    m[0][2] -= s * axis.y;
    m[1][0] -= s * axis.z;
    m[1][2] += s * axis.x;
    m[2][0] += s * axis.y;
    m[2][1] -= s * axis.x;
    return m;
}

dmat4 scale_matrix(const double* v) {
    dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i][i] = v[i];
    return m;
}

dmat4 rows_matrix(const double* v) {
    dmat4 m;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) m[column][row] = v[row * 4 + column];
    // The last row of an affine matrix is 0 0 0 1 (docs/numerics.md#geometry: anything else is
    // ignored).
    for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1.0 : 0.0;
    return m;
}

dmat4 lookat_matrix(const double* v) {
    dvec3 eye(v[0], v[1], v[2]), interest(v[3], v[4], v[5]), up(v[6], v[7], v[8]);
    dvec3 back = eye - interest;
    double distance = glm::length(back);
    if (!(distance > 0)) return translation_matrix(v);
    back /= distance;
    dvec3 right = glm::cross(up, back);
    double sine = glm::length(right);
    right = sine > kLeastSine * glm::length(up) ? right / sine : right_of(back);
    return dmat4(dvec4(right, 0), dvec4(glm::cross(back, right), 0), dvec4(back, 0), dvec4(eye, 1));
}

// COLLADA 1.4.1, chapter 5, names the axes and no formula. This one fits the conformance suite's
// pictures (transform_stack: 0.81 of the silhouette, plain skews 0.995); RiSkew's does not (0.59).
dmat4 skew_matrix(const double* v) {
    dvec3 d1(v[1], v[2], v[3]), d2(v[4], v[5], v[6]);
    double angle = radians(std::remainder(v[0], 360.0)), cosine = std::cos(angle);
    if (!(glm::length(d1) > 0) || !(glm::length(d2) > 0) || !(std::abs(cosine) > 1e-9))
        return dmat4(1.0);
    d1 = glm::normalize(d1);
    d2 = glm::normalize(d2);
    double tangent = std::sin(angle) / cosine;
    dmat4 m(1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) m[column][row] += tangent * d2[column] * d1[row];
    return m;
}

dmat4 quaternion_matrix(const double* v) {
    double length = std::hypot(std::hypot(v[0], v[1]), std::hypot(v[2], v[3]));
    if (!(length > 0) || !std::isfinite(length)) return dmat4(1.0);
    double x = v[0] / length, y = v[1] / length, z = v[2] / length, w = v[3] / length;
    dmat4 m(1.0);
    m[0] = dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
    m[1] = dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
    m[2] = dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
    return m;
}

bool is_singular(const dmat4& m) {
    dvec3 a(m[0]), b(m[1]), c(m[2]);
    double volume = a.x * (b.y * c.z - b.z * c.y) - b.x * (a.y * c.z - a.z * c.y) +
                    c.x * (a.y * b.z - a.z * b.y);
    double box = std::hypot(a.x, a.y, a.z) * std::hypot(b.x, b.y, b.z) * std::hypot(c.x, c.y, c.z);
    return !(std::abs(volume) > 1e-12 * box);
}

}  // namespace kinora
