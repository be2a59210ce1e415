// skin/dual_quaternion.cpp: joints as dual quaternions.
#include "skin/dual_quaternion.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "skin/run_p.h"

namespace kinora::skin {
namespace {

constexpr double kLeastVolume = 1e-9;  // determinant over the cube of the norm: no inverse below

// The nearest orthogonal matrix.
dmat3 orthogonal_part(dmat3 q) {
    for (int turn = 0; turn < 100; ++turn) {
        dmat3 inverse = glm::transpose(glm::inverse(q));
        dmat3 next = 0.5 * (q + inverse);
        double change = 0;
        for (int c = 0; c < 3; ++c) change += glm::dot(next[c] - q[c], next[c] - q[c]);
        q = next;
        if (change < 1e-30) break;
    }
    return q;
}

// Shepperd: "Quaternion from Rotation Matrix", 1978: by the largest of the four.
dvec4 quaternion_of(const dmat3& r) {
    const double squares[4] = {1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
                               1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]};
    int largest = 0;
    for (int i = 1; i < 4; ++i)
        if (squares[i] > squares[largest]) largest = i;
    const double wx = r[1][2] - r[2][1], wy = r[2][0] - r[0][2], wz = r[0][1] - r[1][0];
    const double xy = r[0][1] + r[1][0], xz = r[2][0] + r[0][2], yz = r[1][2] + r[2][1];
    const dvec4 rows[4] = {{squares[0], wx, wy, wz},
                           {wx, squares[1], xy, xz},
                           {wy, xy, squares[2], yz},
                           {wz, xz, yz, squares[3]}};
    const dvec4 q = rows[largest] / std::sqrt(glm::dot(rows[largest], rows[largest]));
    return q.x < 0 ? -q : q;
}

bool has_inverse(const dmat3& m) {
    double norm = 0;
    for (int c = 0; c < 3; ++c) norm += glm::dot(m[c], m[c]);
    return std::isfinite(norm) &&
           std::abs(glm::determinant(m)) > kLeastVolume * norm * std::sqrt(norm);
}

}  // namespace

DualJoint dual_joint(const JointMatrix& matrix) {
    dmat3 m;
    for (int c = 0; c < 3; ++c)
        m[c] = dvec3(double(matrix.c[c][0]), double(matrix.c[c][1]), double(matrix.c[c][2]));
    dmat3 rotation(1.0);
    if (has_inverse(m)) {
        rotation = orthogonal_part(m);
        if (glm::determinant(rotation) < 0) rotation = -rotation;
    }
    const dmat3 stretch = glm::transpose(rotation) * m;
    const dvec4 q = quaternion_of(rotation);
    DualJoint joint;
    for (int i = 0; i < 4; ++i) joint.rotation[i] = float(q[i]);
    for (int i = 0; i < 3; ++i) joint.translation[i] = matrix.c[3][i];
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) joint.stretch[3 * c + r] = float(stretch[c][r]);
    return joint;
}

void deform_dual(const SkinMesh& skin, std::span<const DualJoint> palette,
                 std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                 std::span<vec4> positions, std::span<vec4> normals) {
    deform_dual_with(deform_kernels()[0], skin, palette, rest_positions, rest_normals, positions,
                     normals);
}

void deform_dual_with(const char* kernel, const SkinMesh& skin, std::span<const DualJoint> palette,
                      std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                      std::span<vec4> positions, std::span<vec4> normals) {
    CHECK_EQ(palette.size(), skin.joint_count + 1);
    run_kernel(kernel, Blending::Dual,
               {skin, palette[0].rotation, rest_positions, rest_normals, positions, normals});
}

}  // namespace kinora::skin
