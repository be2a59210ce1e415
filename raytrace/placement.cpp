// raytrace/placement.cpp: the matrix of an instance, checked once, and what it does to points.
#include "raytrace/placement_p.h"

#include <algorithm>
#include <cmath>

namespace kinora::raytrace {

namespace {

dvec3 cross(dvec3 a, dvec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot(dvec3 a, dvec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Embree inverts the matrix in floats, by cofactors over the determinant.
bool invertible_in_floats(const dvec3 cofactors[3], double determinant) {
    constexpr double smallest = 0x1p-120, largest = 0x1p120;
    if (!(std::abs(determinant) > smallest && std::abs(determinant) < largest)) return false;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(cofactors[i][k] / determinant) < largest)) return false;
    return true;
}

}  // namespace

bool make_placement(const dmat4& matrix, Placement& out) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) out.m[3 * c + r] = float(matrix[c][r]);
    dvec3 x{matrix[0]}, y{matrix[1]}, z{matrix[2]}, t{matrix[3]};
    if (!(std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) < 1e18)) return false;
    // Columns of the cofactor matrix; they are also the rows of the inverse times det.
    const dvec3 cofactors[3] = {cross(y, z), cross(z, x), cross(x, y)};
    const double determinant = dot(x, cofactors[0]);
    if (!invertible_in_floats(cofactors, determinant)) return false;

    double largest = 0;
    for (const dvec3& c : cofactors)
        largest = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    const dvec3 columns[3] = {x, y, z};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            // Times the sign of det: M^-T up to scale, so mirrors keep the outside outside.
            out.normal[3 * r + c] =
                float(std::copysign(1.0, determinant) * cofactors[c][r] / largest);
            double sum = 0;
            for (int k = 0; k < 3; ++k)
                sum += std::abs(columns[k][r]) * std::abs(cofactors[k][c] / determinant);
            out.there_and_back[3 * r + c] = float(sum);
        }
    return true;
}

void place_point(const Placement& placement, vec3& p, vec3& p_error) {
    const float* m = placement.m;
    vec3 q{0.0f}, error{0.0f}, size{0.0f};
    for (int r = 0; r < 3; ++r) {
        q[r] = m[r] * p.x + m[3 + r] * p.y + m[6 + r] * p.z + m[9 + r];
        float scaled_error = std::abs(m[r]) * p_error.x + std::abs(m[3 + r]) * p_error.y +
                             std::abs(m[6 + r]) * p_error.z;
        float terms = std::abs(m[r] * p.x) + std::abs(m[3 + r] * p.y) + std::abs(m[6 + r] * p.z) +
                      std::abs(m[9 + r]);
        error[r] = (1 + gamma(3)) * scaled_error + gamma(4) * terms;
        size[r] = std::abs(q[r]) + std::abs(m[9 + r]);
    }
    // The next ray's origin goes back to local space through Embree's own float inverse (cofactors
    // over determinant, then the product): about eight roundings of |M^-1| (|q| + |t|).
    const float* a = placement.there_and_back;
    for (int r = 0; r < 3; ++r)
        p_error[r] = error[r] +
                     gamma(8) * (a[3 * r] * size.x + a[3 * r + 1] * size.y + a[3 * r + 2] * size.z);
    p = q;
}

vec3 place_normal(const Placement& placement, vec3 n) {
    const float* m = placement.normal;
    return {m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
            m[6] * n.x + m[7] * n.y + m[8] * n.z};
}

}  // namespace kinora::raytrace
