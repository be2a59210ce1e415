// raytrace/placement.cpp: the matrix of an instance, checked once, and what it does to points.
#include "raytrace/placement_p.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora::raytrace {

namespace {

constexpr double kLargestGain = 1e10;
constexpr double kLargestLocal = 1.7e18;  // a little under Embree's limit, for rounding
constexpr double kLeastLargestOrigin = 1e8;

// Largest sum of absolute values over the rows of the matrix with these columns.
double gain(const dvec3 columns[3]) {
    double largest = 0;
    for (int r = 0; r < 3; ++r)
        largest = std::max(
            largest, std::abs(columns[0][r]) + std::abs(columns[1][r]) + std::abs(columns[2][r]));
    return largest;
}

}  // namespace

bool make_placement(const dmat4& matrix, float accel_scale, float local_scale, Placement& out) {
    const double gain_scale = double(accel_scale) / double(local_scale);
    for (int c = 0; c < 4; ++c) {
        const double scale = c < 3 ? gain_scale : double(accel_scale);
        for (int r = 0; r < 3; ++r) {
            out.m[3 * c + r] = float(matrix[c][r]);
            out.traced[3 * c + r] = float(scale * matrix[c][r]);
        }
    }
    const dvec3 x = gain_scale * dvec3{matrix[0]}, y = gain_scale * dvec3{matrix[1]},
                z = gain_scale * dvec3{matrix[2]}, t = double(accel_scale) * dvec3{matrix[3]};
    // Columns of the cofactor matrix; they are also the rows of the inverse times det.
    const dvec3 cofactors[3] = {cross(y, z), cross(z, x), cross(x, y)};
    const double determinant = dot(x, cofactors[0]);
    const dvec3 columns[3] = {x, y, z};
    dvec3 inverse[3];  // columns
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) inverse[c][r] = cofactors[r][c] / determinant;
    // Embree inverts in floats, so the determinant must be one, too.
    const bool sound = std::abs(determinant) > 0x1p-120 && std::abs(determinant) < 0x1p120 &&
                       gain(columns) <= kLargestGain && gain(inverse) <= kLargestGain;
    if (!sound) return false;
    const double largest_origin =
        kLargestLocal / gain(inverse) - std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)});
    if (!(largest_origin >= kLeastLargestOrigin)) return false;
    out.largest_origin = float(largest_origin);

    double largest = 0;
    for (const dvec3& c : cofactors)
        largest = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            // Times the sign of det: M^-T up to scale, so mirrors keep the outside outside.
            out.normal[3 * r + c] =
                float(std::copysign(1.0, determinant) * cofactors[c][r] / largest);
            double sum = 0;
            for (int k = 0; k < 3; ++k) sum += std::abs(columns[k][r]) * std::abs(inverse[c][k]);
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
