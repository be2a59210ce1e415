// runtime/scene/gltf/curves/trs.cpp: affine matrices as translation, rotation and scale.
#include "runtime/scene/gltf/curves/trs.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "anim/decompose.h"

namespace kinora {

namespace {

constexpr double kOrthogonal = 1e-6;  // cosine between columns that counts as none

std::array<double, 4> quaternion(const dmat3& rotation) {
    anim::Quaternion q = anim::normalized(anim::quaternion_from_rotation(rotation));
    return {q.x, q.y, q.z, q.w};
}

// Axes along those of `m` that are not zero, right-handed and at right angles.
dmat3 completed_axes(const dmat3& m, const dvec3& lengths) {
    dmat3 axes(1.0);
    int known = -1;
    for (int i = 0; i < 3; ++i)
        if (lengths[i] > 0) axes[i] = m[i] / lengths[i], known = i;
    if (known < 0) return dmat3(1.0);
    for (int i = 0; i < 3; ++i) {
        if (lengths[i] > 0) continue;
        int a = (i + 1) % 3, b = (i + 2) % 3;
        if (lengths[a] > 0 && lengths[b] > 0) {
            axes[i] = glm::cross(axes[a], axes[b]);
            continue;
        }
        // One axis alone is known: any two across it do.
        dvec3 u = axes[known];
        dvec3 other = std::abs(u.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        axes[(known + 1) % 3] = glm::normalize(glm::cross(u, other));
        axes[(known + 2) % 3] = glm::cross(u, axes[(known + 1) % 3]);
        break;
    }
    return axes;
}

// Eigenvectors of a symmetric matrix as the columns of a rotation: Jacobi's method.
dmat3 eigenvectors(dmat3 s) {
    dmat3 v(1.0);
    for (int sweep = 0; sweep < 30; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(s[q][p]) < 1e-300) continue;
                double theta = 0.5 * std::atan2(2 * s[q][p], s[q][q] - s[p][p]);
                dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = std::cos(theta);
                turn[q][p] = std::sin(theta);
                turn[p][q] = -std::sin(theta);
                s = glm::transpose(turn) * s * turn;
                v = v * turn;
            }
    return v;
}

}  // namespace

bool is_identity(const dmat4& m, double tolerance) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(std::abs(m[c][r] - (c == r ? 1.0 : 0.0)) <= tolerance)) return false;
    return true;
}

bool decompose_trs(const dmat4& m, Trs& trs) {
    trs.translation = dvec3(m[3]);
    dmat3 linear(m);
    dvec3 lengths(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    if (glm::determinant(linear) < 0) {
        linear[0] = -linear[0];
        trs.scale = dvec3(-lengths.x, lengths.y, lengths.z);
    } else {
        trs.scale = lengths;
    }
    for (int i = 0; i < 3; ++i)
        if (std::abs(std::abs(trs.scale[i]) - 1) < 1e-12)
            trs.scale[i] = std::copysign(1.0, trs.scale[i]);
    dmat3 axes = completed_axes(linear, lengths);
    trs.rotation = quaternion(axes);
    auto across = [&](int a, int b) { return std::abs(glm::dot(axes[a], axes[b])) < kOrthogonal; };
    return across(0, 1) && across(0, 2) && across(1, 2);
}

// M = R S (polar) and S = V diag V^T, so M = (R V) diag * V^T: two nodes.
void split_shear(const dmat4& m, Trs& outer, Trs& inner) {
    anim::Matrix16 rows;
    for (size_t r = 0; r < 4; ++r)
        for (size_t c = 0; c < 4; ++c) rows[r * 4 + c] = m[int(c)][int(r)];
    anim::RigidStretch polar = anim::decompose(rows);
    dmat3 v = eigenvectors(polar.stretch);
    dmat3 diagonal = glm::transpose(v) * polar.stretch * v;
    outer.translation = polar.translation;
    outer.rotation = quaternion(anim::rotation_from_quaternion(polar.rotation) * v);
    outer.scale = {diagonal[0][0], diagonal[1][1], diagonal[2][2]};
    inner.rotation = quaternion(glm::transpose(v));
}

}  // namespace kinora
