// skin/dual_quaternion.cpp: joints as dual quaternions, and vertices moved by their sums.
#include "skin/dual_quaternion.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "skin/influences_p.h"

namespace kinora::skin {
namespace {

constexpr size_t kDualChunk = 64;      // blocks
constexpr float kHalfTurn = 1e-6f;     // cosine of half the angle below which it is a half turn
constexpr double kLeastVolume = 1e-9;  // determinant over the cube of the norm: no inverse below

// ---- joints -----------------------------------------------------------------------------------

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

// ---- vertices ---------------------------------------------------------------------------------

struct Quat {
    float w = 0, x = 0, y = 0, z = 0;
};

Quat times(const Quat& a, const Quat& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
Quat conjugate(const Quat& q) {
    return {q.w, -q.x, -q.y, -q.z};
}
float dot4(const Quat& a, const Quat& b) {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
void add(Quat& sum, float weight, const Quat& q) {
    sum.w += weight * q.w, sum.x += weight * q.x;
    sum.y += weight * q.y, sum.z += weight * q.z;
}
Quat rotation_of(const DualJoint& j) {
    return {j.rotation[0], j.rotation[1], j.rotation[2], j.rotation[3]};
}

// 1, or -1 where the other of the two quaternions of q's rotation is on the side of `first`.
float side(const Quat& first, const Quat& q) {
    const float cosine = dot4(first, q);
    if (std::abs(cosine) > kHalfTurn) return cosine < 0 ? -1.0f : 1.0f;
    const Quat turn = times(q, conjugate(first));
    for (float v : {turn.x, turn.y, turn.z})
        if (std::abs(v) > kHalfTurn) return v < 0 ? -1.0f : 1.0f;
    return 1.0f;
}

// The matrix of one vertex: linear part by columns, and translation.
struct VertexMatrix {
    vec3 column[3];
    vec3 translation;
};

VertexMatrix vertex_matrix(const Quat& q, const Quat& dual, const float stretch[9]) {
    const float n = 1 / dot4(q, q);  // the rotation is that of q / |q|
    const float xx = q.x * q.x * n, yy = q.y * q.y * n, zz = q.z * q.z * n;
    const float xy = q.x * q.y * n, xz = q.x * q.z * n, yz = q.y * q.z * n;
    const float wx = q.w * q.x * n, wy = q.w * q.y * n, wz = q.w * q.z * n;
    const vec3 r[3] = {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
                       {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
                       {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
    VertexMatrix m;
    for (int c = 0; c < 3; ++c)
        m.column[c] = r[0] * stretch[3 * c] + r[1] * stretch[3 * c + 1] + r[2] * stretch[3 * c + 2];
    const Quat t = times(dual, conjugate(q));
    m.translation = vec3(t.x, t.y, t.z) * (2 * n);
    return m;
}

// Of vertex 0 .. 15 of a block; `weights` and `offsets` are the block's.
VertexMatrix blended(const float* palette, const float* weights, const uint32_t* offsets,
                     uint32_t rounds, uint32_t vertex) {
    Quat q, dual, first;
    float stretch[9] = {};
    for (uint32_t r = 0; r < rounds; ++r) {
        const uint32_t entry = entry_of(rounds, r, vertex);
        const auto& joint = *reinterpret_cast<const DualJoint*>(palette + offsets[entry]);
        const Quat rotation = rotation_of(joint);
        if (r == 0) first = rotation;
        const float weight = weights[entry];
        if (weight == 0) continue;  // padding
        const float signed_weight = weight * side(first, rotation);
        add(q, signed_weight, rotation);
        const Quat t{0, joint.translation[0], joint.translation[1], joint.translation[2]};
        add(dual, 0.5f * signed_weight, times(t, rotation));
        for (int i = 0; i < 9; ++i) stretch[i] += weight * joint.stretch[i];
    }
    if (!(dot4(q, q) > 1e-12f)) q = first;  // negative weights that cancel
    return vertex_matrix(q, dual, stretch);
}

vec4 moved(const VertexMatrix& m, const vec4& p) {
    return vec4(m.column[0] * p.x + m.column[1] * p.y + m.column[2] * p.z + m.translation, 0.0f);
}

// sign(det) cofactor(M) n, unit; 0 where it vanishes.
vec4 turned(const VertexMatrix& m, const vec4& n) {
    const dvec3 a(m.column[0]), b(m.column[1]), c(m.column[2]);
    const dvec3 bc = glm::cross(b, c);
    const dvec3 sum =
        bc * double(n.x) + glm::cross(c, a) * double(n.y) + glm::cross(a, b) * double(n.z);
    const double length = std::sqrt(glm::dot(sum, sum));
    if (!std::isfinite(length) || !(length > 0)) return vec4(0.0f);
    return vec4(vec3(sum * std::copysign(1 / length, glm::dot(bc, a))), 0.0f);
}

// Calls move(vertex, matrix) for each.
template <class Move>
void each_vertex(const InfluenceBlocks& blocks, std::span<const DualJoint> palette,
                 const Move& move) {
    const size_t count = (blocks.count + InfluenceBlocks::kBlock - 1) / InfluenceBlocks::kBlock;
    const float* joints = palette.empty() ? nullptr : palette[0].rotation;
    parallel_for(0, count, kDualChunk, [&](size_t begin, size_t end) {
        for (size_t block = begin; block < end; ++block) {
            const uint32_t first = blocks.first[block];
            const uint32_t rounds = blocks.first[block + 1] - first;
            const size_t from = block * InfluenceBlocks::kBlock,
                         to = std::min(blocks.count, from + InfluenceBlocks::kBlock);
            for (size_t v = from; v < to; ++v)
                move(v, blended(joints,
                                blocks.weights.data() + size_t(first) * InfluenceBlocks::kBlock,
                                blocks.offsets.data() + size_t(first) * InfluenceBlocks::kBlock,
                                rounds, uint32_t(v - from)));
        }
    });
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
    CHECK_EQ(palette.size(), skin.joint_count + 1);
    CHECK_EQ(rest_positions.size(), skin.positions.count);
    CHECK_EQ(positions.size(), skin.positions.count);
    CHECK_EQ(rest_normals.size(), skin.normal_count);
    CHECK_EQ(normals.size(), skin.normal_count);
    each_vertex(skin.positions, palette, [&](size_t v, const VertexMatrix& m) {
        positions[v] = moved(m, rest_positions[v]);
        if (skin.shared_normals) normals[v] = turned(m, rest_normals[v]);
    });
    if (skin.shared_normals) return;
    each_vertex(skin.normals, palette,
                [&](size_t v, const VertexMatrix& m) { normals[v] = turned(m, rest_normals[v]); });
}

}  // namespace kinora::skin
