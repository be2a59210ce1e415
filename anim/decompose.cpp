// anim/decompose.cpp: polar decomposition by a one-sided Jacobi SVD, slerp and nlerp.
#include "anim/decompose.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace kinora::anim {
namespace {

constexpr double kTurnTie = 1e-12;  // |cos of half the turn| below which it counts as 180 degrees

Quaternion multiply(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion negated(const Quaternion& q) {
    return {-q.w, -q.x, -q.y, -q.z};
}

// Whether the first component that is clearly not zero is negative.
bool axis_is_negative(const Quaternion& q) {
    for (double v : {q.x, q.y, q.z})
        if (std::abs(v) > 1e-9) return v < 0;
    return false;
}

// Of the two quaternions of one turn, the one that slerp follows.
Quaternion short_way(const Quaternion& turn) {
    bool flip = std::abs(turn.w) <= kTurnTie ? axis_is_negative(turn) : turn.w < 0;
    return flip ? negated(turn) : turn;
}

// One-sided Jacobi (Hestenes): turns pairs of columns of w until all are orthogonal, so that
// w = a v with v a rotation.
void orthogonalise_columns(dmat3& w, dmat3& v) {
    constexpr int kSweeps = 30;  // converges quadratically; under ten even for bad matrices
    constexpr int kPairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool turned = false;
        for (auto [p, q] : kPairs) {
            double pp = glm::dot(w[p], w[p]), qq = glm::dot(w[q], w[q]), pq = glm::dot(w[p], w[q]);
            if (std::abs(pq) <= 1e-17 * std::sqrt(pp * qq)) continue;
            turned = true;
            double zeta = (qq - pp) / (2 * pq);
            double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
            double c = 1 / std::sqrt(1 + t * t), s = c * t;
            for (dmat3* m : {&w, &v}) {
                dvec3 column = (*m)[p];
                (*m)[p] = c * column - s * (*m)[q];
                (*m)[q] = s * column + c * (*m)[q];
            }
        }
        if (!turned) return;
    }
}

// A unit vector across u, as near to `wish` as can be.
dvec3 unit_across(const dvec3& u, const dvec3& wish, const dvec3& other_wish) {
    dvec3 across = wish - glm::dot(wish, u) * u;
    if (glm::dot(across, across) < 1e-3) across = other_wish - glm::dot(other_wish, u) * u;
    return glm::normalize(across);
}

// The orthogonal factor of a's polar decomposition; det -1 where a mirrors. Columns whose singular
// value is nothing are completed so that the result is a rotation near v.
dmat3 orthogonal_factor(const dmat3& a) {
    dmat3 w = a, v(1.0), u(0.0);
    orthogonalise_columns(w, v);
    double length[3];
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 3; ++i) length[i] = glm::length(w[i]);
    std::sort(order, order + 3, [&](int i, int j) { return length[i] > length[j]; });
    int rank = 0;
    while (rank < 3 && length[order[rank]] > 1e-15 * length[order[0]]) ++rank;
    if (rank == 0) return dmat3(1.0);

    auto [i, j, k] = order;
    u[i] = w[i] / length[i];
    u[j] = rank > 1 ? w[j] / length[j] : unit_across(u[i], v[j], v[k]);
    // sign of the permutation (i, j, k): the third of an ordered frame
    double sign = (j - i + 3) % 3 == 1 ? 1 : -1;
    u[k] = rank > 2 ? w[k] / length[k] : sign * glm::cross(u[i], u[j]);
    return u * glm::transpose(v);
}

double largest_entry(const dmat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(m[c][r]));
    return largest;
}

}  // namespace

Quaternion normalized(const Quaternion& q) {
    double largest = std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    if (!(largest > 0) || !std::isfinite(q.w + q.x + q.y + q.z)) return {};
    double w = q.w / largest, x = q.x / largest, y = q.y / largest, z = q.z / largest;
    double length = std::sqrt(w * w + x * x + y * y + z * z);
    return {w / length, x / length, y / length, z / length};
}

// Shepperd 1978: divide by the largest of the four, so that no small one is magnified.
Quaternion quaternion_from_rotation(const dmat3& m) {
    double trace = m[0][0] + m[1][1] + m[2][2];
    double squares[4] = {trace, m[0][0], m[1][1], m[2][2]};
    switch (std::max_element(squares, squares + 4) - squares) {
        case 0:
            return normalized({1 + trace, m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]});
        case 1:
            return normalized(
                {m[1][2] - m[2][1], 1 + 2 * m[0][0] - trace, m[0][1] + m[1][0], m[2][0] + m[0][2]});
        case 2:
            return normalized(
                {m[2][0] - m[0][2], m[0][1] + m[1][0], 1 + 2 * m[1][1] - trace, m[1][2] + m[2][1]});
        default:
            return normalized(
                {m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], 1 + 2 * m[2][2] - trace});
    }
}

dmat3 rotation_from_quaternion(const Quaternion& q) {
    double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return {1 - 2 * (yy + zz), 2 * (xy + wz),     2 * (xz - wy),       // column 0
            2 * (xy - wz),     1 - 2 * (xx + zz), 2 * (yz + wx),       // column 1
            2 * (xz + wy),     2 * (yz - wx),     1 - 2 * (xx + yy)};  // column 2
}

Quaternion slerp(const Quaternion& from, const Quaternion& to, double s) {
    Quaternion a = normalized(from), b = normalized(to);
    Quaternion turn = short_way(multiply({a.w, -a.x, -a.y, -a.z}, b));
    double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    double half_angle = std::atan2(sine, turn.w);
    // sin(s x)/sin(x) tends to s for no turn at all
    double scale = sine > 1e-150 ? std::sin(s * half_angle) / sine : s;
    return normalized(
        multiply(a, {std::cos(s * half_angle), scale * turn.x, scale * turn.y, scale * turn.z}));
}

Quaternion nlerp(const Quaternion& from, const Quaternion& to, double s) {
    Quaternion a = normalized(from), b = normalized(to);
    // b or -b, whichever is nearer
    const Quaternion end = multiply(a, short_way(multiply({a.w, -a.x, -a.y, -a.z}, b)));
    return normalized({a.w + (end.w - a.w) * s, a.x + (end.x - a.x) * s, a.y + (end.y - a.y) * s,
                       a.z + (end.z - a.z) * s});
}

Quaternion between(const Quaternion& a, const Quaternion& b, double s, RotationPath path) {
    return path == RotationPath::Slerp ? slerp(a, b, s) : nlerp(a, b, s);
}

RigidStretch decompose(const Matrix16& m) {
    RigidStretch r;
    dmat3 a;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) a[column][row] = m[row * 4 + column];
        r.translation[row] = m[row * 4 + 3];
    }
    r.last_row = {m[12], m[13], m[14], m[15]};

    double scale = largest_entry(a);
    if (scale > 0) {
        dmat3 rotation = orthogonal_factor(a / scale);
        if (glm::determinant(rotation) < 0) rotation = -rotation;
        r.rotation = quaternion_from_rotation(rotation);
    }
    // from the rotation as it is kept, so that compose() gives the matrix back to rounding
    r.stretch = glm::transpose(rotation_from_quaternion(r.rotation)) * a;
    return r;
}

Matrix16 compose(const RigidStretch& r) {
    dmat3 a = rotation_from_quaternion(r.rotation) * r.stretch;
    Matrix16 m;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) m[row * 4 + column] = a[column][row];
        m[row * 4 + 3] = r.translation[row];
    }
    for (int column = 0; column < 4; ++column) m[12 + column] = r.last_row[column];
    return m;
}

RigidStretch interpolate(const RigidStretch& a, const RigidStretch& b, double s,
                         RotationPath path) {
    RigidStretch r;
    r.translation = a.translation + (b.translation - a.translation) * s;
    r.rotation = between(a.rotation, b.rotation, s, path);
    r.stretch = a.stretch + (b.stretch - a.stretch) * s;
    r.last_row = a.last_row + (b.last_row - a.last_row) * s;
    return r;
}

}  // namespace kinora::anim
