// skin/dual_kernel_p.h: the kernel of dual quaternions, a template over the vertices done at once.
//
// A vector holds one number of kLanes vertices. GCC's and Clang's vector types are used, whose
// operations are IEEE's for each lane; the order of operations is the same for any width, so all
// instruction sets give the same bits.
#pragma once

#include <cstring>

#include "skin/deform_p.h"

#define KINORA_DUAL_INLINE __attribute__((always_inline)) inline

namespace kinora::skin {
namespace {

constexpr float kHalfTurn = 1e-6f;  // cosine of half the angle below which it is a half turn
constexpr uint32_t kDualBlock = 16, kJointFloats = 16;

template <int kLanes>
struct DualVectors {
    typedef float Floats __attribute__((vector_size(4 * kLanes)));
    typedef int32_t Ints __attribute__((vector_size(4 * kLanes)));
    static constexpr int kHalf = kLanes / 2;  // doubles in a register of that size
    typedef float HalfFloats __attribute__((vector_size(4 * kHalf)));
    typedef double Doubles __attribute__((vector_size(8 * kHalf)));
    typedef int64_t Longs __attribute__((vector_size(8 * kHalf)));
};

// A float for each vertex, or of one alone.
template <class T>
struct Quat {
    T w, x, y, z;
};

template <class T>
KINORA_DUAL_INLINE Quat<T> times(const Quat<T>& a, const Quat<T>& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <class T>
KINORA_DUAL_INLINE Quat<T> conjugate(const Quat<T>& q) {
    return {q.w, -q.x, -q.y, -q.z};
}
template <class T>
KINORA_DUAL_INLINE T dot4(const Quat<T>& a, const Quat<T>& b) {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

// 1, or -1 where the other of the two quaternions of q's rotation is on the side of `first`, which
// is half a turn away.
inline float side_of_half_turn(const Quat<float>& first, const Quat<float>& q) {
    const Quat<float> turn = times(q, conjugate(first));
    const float axis[3] = {turn.x, turn.y, turn.z};
    for (float v : axis)
        if (v > kHalfTurn || v < -kHalfTurn) return v < 0 ? -1.0f : 1.0f;
    return 1.0f;
}

template <int kLanes>
class DualKernel {
    using V = DualVectors<kLanes>;
    using Floats = typename V::Floats;
    using Ints = typename V::Ints;
    using Quats = Quat<Floats>;

    struct Matrix {
        Floats column[3][3];  // of the linear part
        Floats translation[3];
    };

    static KINORA_DUAL_INLINE Floats load(const float* p) {
        Floats v;
        std::memcpy(&v, p, sizeof v);
        return v;
    }

    typedef float Float4 __attribute__((vector_size(16)));

    static KINORA_DUAL_INLINE Float4 load4(const float* p) {
        Float4 v;
        std::memcpy(&v, p, sizeof v);
        return v;
    }

    // Four floats each of vertices first, first + 4, first + 8 ...
    template <class At>
    static KINORA_DUAL_INLINE Floats quads(const At& at, int first) {
        if constexpr (kLanes == 4) {
            return load4(at(first));
        } else if constexpr (kLanes == 8) {
            return __builtin_shufflevector(load4(at(first)), load4(at(first + 4)), 0, 1, 2, 3, 4, 5,
                                           6, 7);
        } else {
            const auto low = __builtin_shufflevector(load4(at(first)), load4(at(first + 4)), 0, 1,
                                                     2, 3, 4, 5, 6, 7);
            const auto high = __builtin_shufflevector(load4(at(first + 8)), load4(at(first + 12)),
                                                      0, 1, 2, 3, 4, 5, 6, 7);
            return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13,
                                           14, 15);
        }
    }

    // Of each four floats of a and of b: those of the indices, 4 and more of b.
    template <int i, int j, int k, int l>
    static KINORA_DUAL_INLINE Floats pick(const Floats& a, const Floats& b) {
        constexpr int kFirstOfB = kLanes - 4;
#define KINORA_OF(part, index) (4 * (part) + ((index) < 4 ? (index) : (index) + kFirstOfB))
#define KINORA_PART(part) \
    KINORA_OF(part, i), KINORA_OF(part, j), KINORA_OF(part, k), KINORA_OF(part, l)
        if constexpr (kLanes == 4) {
            return __builtin_shufflevector(a, b, KINORA_PART(0));
        } else if constexpr (kLanes == 8) {
            return __builtin_shufflevector(a, b, KINORA_PART(0), KINORA_PART(1));
        } else {
            return __builtin_shufflevector(a, b, KINORA_PART(0), KINORA_PART(1), KINORA_PART(2),
                                           KINORA_PART(3));
        }
#undef KINORA_PART
#undef KINORA_OF
    }

    // Rows of four floats a vertex to a row for each of the four; and back, as it is its own
    // inverse.
    static KINORA_DUAL_INLINE void transpose(Floats r[4]) {
        const Floats low01 = pick<0, 4, 1, 5>(r[0], r[1]), high01 = pick<2, 6, 3, 7>(r[0], r[1]);
        const Floats low23 = pick<0, 4, 1, 5>(r[2], r[3]), high23 = pick<2, 6, 3, 7>(r[2], r[3]);
        r[0] = pick<0, 1, 4, 5>(low01, low23);
        r[1] = pick<2, 3, 6, 7>(low01, low23);
        r[2] = pick<0, 1, 4, 5>(high01, high23);
        r[3] = pick<2, 3, 6, 7>(high01, high23);
    }

    static KINORA_DUAL_INLINE Floats sides(const Quats& first, const Quats& q) {
        const Floats cosine = dot4(first, q);
        const Ints clear = (cosine > kHalfTurn) | (cosine < -kHalfTurn);
        Floats side = cosine < 0.0f ? -1.0f - Floats{} : 1.0f - Floats{};
        uint64_t pairs[kLanes / 2], all = ~uint64_t(0);
        std::memcpy(pairs, &clear, sizeof clear);
        for (uint64_t pair : pairs) all &= pair;
        if (all == ~uint64_t(0)) [[likely]]
            return side;
        for (int l = 0; l < kLanes; ++l)
            if (!clear[l])
                side[l] = side_of_half_turn({first.w[l], first.x[l], first.y[l], first.z[l]},
                                            {q.w[l], q.x[l], q.y[l], q.z[l]});
        return side;
    }

    static KINORA_DUAL_INLINE void add(Floats& sum, Ints counts, Floats term) {
        sum = counts ? sum + term : sum;
    }

    static KINORA_DUAL_INLINE Matrix matrix_of(const Quats& q, const Quats& dual,
                                               const Floats stretch[9]) {
        const Floats n = 1.0f / dot4(q, q);  // the rotation is that of q / |q|
        const Floats xx = q.x * q.x * n, yy = q.y * q.y * n, zz = q.z * q.z * n;
        const Floats xy = q.x * q.y * n, xz = q.x * q.z * n, yz = q.y * q.z * n;
        const Floats wx = q.w * q.x * n, wy = q.w * q.y * n, wz = q.w * q.z * n;
        const Floats r[3][3] = {{1.0f - 2.0f * (yy + zz), 2.0f * (xy + wz), 2.0f * (xz - wy)},
                                {2.0f * (xy - wz), 1.0f - 2.0f * (xx + zz), 2.0f * (yz + wx)},
                                {2.0f * (xz + wy), 2.0f * (yz - wx), 1.0f - 2.0f * (xx + yy)}};
        Matrix m;
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k)
                m.column[c][k] = r[0][k] * stretch[3 * c] + r[1][k] * stretch[3 * c + 1] +
                                 r[2][k] * stretch[3 * c + 2];
        const Quats t = times(dual, conjugate(q));
        m.translation[0] = t.x * (2.0f * n);
        m.translation[1] = t.y * (2.0f * n);
        m.translation[2] = t.z * (2.0f * n);
        return m;
    }

    // The 16 numbers of the joints of influence `round` of vertices vertex, vertex + 1, ...; their
    // weights.
    static KINORA_DUAL_INLINE Floats gather(const float* palette, const float* weights,
                                            const uint32_t* offsets, uint32_t rounds,
                                            uint32_t round, uint32_t vertex,
                                            Floats (&rows)[kJointFloats]) {
        const uint32_t set = round / 4 * 4;
        const uint32_t width = rounds - set < 4 ? rounds - set : 4;
        const uint32_t first = set * kDualBlock + vertex * width + (round - set);
        float weight[kLanes];
        const float* joints[kLanes];
#pragma GCC unroll 16
        for (uint32_t l = 0; l < uint32_t(kLanes); ++l) {
            weight[l] = weights[first + l * width];
            joints[l] = palette + offsets[first + l * width];
        }
#pragma GCC unroll 4
        for (int quad = 0; quad < 4; ++quad) {
#pragma GCC unroll 4
            for (int l = 0; l < 4; ++l)
                rows[4 * quad + l] = quads([&](int v) { return joints[v] + 4 * quad; }, l);
            transpose(rows + 4 * quad);
        }
        return load(weight);
    }

    static KINORA_DUAL_INLINE Matrix blended(const float* palette, const float* weights,
                                             const uint32_t* offsets, uint32_t rounds,
                                             uint32_t vertex) {
        Quats q{}, dual{}, first{};
        Floats stretch[9] = {};
        for (uint32_t r = 0; r < rounds; ++r) {
            Floats rows[kJointFloats];
            const Floats weight = gather(palette, weights, offsets, rounds, r, vertex, rows);
            const Quats rotation{rows[0], rows[1], rows[2], rows[3]};
            if (r == 0) first = rotation;
            const Ints counts = weight != 0.0f;  // others are padding
            const Floats signed_weight = weight * sides(first, rotation);
            add(q.w, counts, signed_weight * rotation.w);
            add(q.x, counts, signed_weight * rotation.x);
            add(q.y, counts, signed_weight * rotation.y);
            add(q.z, counts, signed_weight * rotation.z);
            const Quats t = times(Quats{Floats{}, rows[4], rows[5], rows[6]}, rotation);
            const Floats half = 0.5f * signed_weight;
            add(dual.w, counts, half * t.w);
            add(dual.x, counts, half * t.x);
            add(dual.y, counts, half * t.y);
            add(dual.z, counts, half * t.z);
#pragma GCC unroll 9
            for (int i = 0; i < 9; ++i) add(stretch[i], counts, weight * rows[7 + i]);
        }
        const Ints good = dot4(q, q) > 1e-12f;  // not so: negative weights that cancel
        q.w = good ? q.w : first.w;
        q.x = good ? q.x : first.x;
        q.y = good ? q.y : first.y;
        q.z = good ? q.z : first.z;
        return matrix_of(q, dual, stretch);
    }

    // kLanes vertices of four floats as four rows, and back.
    static KINORA_DUAL_INLINE void read_rows(const float* from, Floats (&rows)[4]) {
#pragma GCC unroll 4
        for (int l = 0; l < 4; ++l) rows[l] = quads([&](int v) { return from + 4 * v; }, l);
        transpose(rows);
    }
    static KINORA_DUAL_INLINE void write_rows(Floats (&rows)[4], float* to) {
        transpose(rows);
#pragma GCC unroll 4
        for (int l = 0; l < 4; ++l)
#pragma GCC unroll 4
            for (int part = 0; part < kLanes / 4; ++part)
                std::memcpy(to + 4 * (l + 4 * part),
                            reinterpret_cast<const char*>(&rows[l]) + 16 * part, 16);
    }

    static KINORA_DUAL_INLINE void move(const Matrix& m, const float* rest, float* out) {
        Floats p[4], moved[4];
        read_rows(rest, p);
#pragma GCC unroll 3
        for (int k = 0; k < 3; ++k)
            moved[k] = m.column[0][k] * p[0] + m.column[1][k] * p[1] + m.column[2][k] * p[2] +
                       m.translation[k];
        moved[3] = Floats{};
        write_rows(moved, out);
    }

    using Doubles = typename V::Doubles;
    using Longs = typename V::Longs;

    static KINORA_DUAL_INLINE Doubles widened(const float* p) {
        typename V::HalfFloats half;
        std::memcpy(&half, p, sizeof half);
        return __builtin_convertvector(half, Doubles);
    }
    static KINORA_DUAL_INLINE void cross(const Doubles a[3], const Doubles b[3], Doubles out[3]) {
        out[0] = a[1] * b[2] - b[1] * a[2];
        out[1] = a[2] * b[0] - b[2] * a[0];
        out[2] = a[0] * b[1] - b[0] * a[1];
    }

    // sign(det) cofactor(M) n, unit; 0 where it vanishes. In double: cofactors leave float's range
    // before their direction is lost.
    static KINORA_DUAL_INLINE void turn_half(const float (&columns)[9][kLanes],
                                             const float (&rest)[4][kLanes], int at,
                                             float (&turned)[4][kLanes]) {
        Doubles a[3], b[3], c[3], bc[3], ca[3], ab[3], sum[3];
        for (int k = 0; k < 3; ++k) {
            a[k] = widened(columns[k] + at);
            b[k] = widened(columns[3 + k] + at);
            c[k] = widened(columns[6 + k] + at);
        }
        cross(b, c, bc);
        cross(c, a, ca);
        cross(a, b, ab);
        const Doubles x = widened(rest[0] + at), y = widened(rest[1] + at),
                      z = widened(rest[2] + at);
        for (int k = 0; k < 3; ++k) sum[k] = bc[k] * x + ca[k] * y + ab[k] * z;
        Doubles length = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
        double roots[V::kHalf];
        std::memcpy(roots, &length, sizeof length);
        for (double& root : roots) root = __builtin_sqrt(root);
        std::memcpy(&length, roots, sizeof length);
        const Doubles det = bc[0] * a[0] + bc[1] * a[1] + bc[2] * a[2];
        const Longs sign = Longs{} + INT64_MIN;
        const Doubles scale = (Doubles)(((Longs)(1.0 / length) & ~sign) | ((Longs)det & sign));
        const Longs good = (length > 0.0) & (length < Doubles{} + __builtin_inf());
        for (int k = 0; k < 3; ++k) {
            const Doubles unit = good ? sum[k] * scale : Doubles{};
            const auto narrow = __builtin_convertvector(unit, typename V::HalfFloats);
            std::memcpy(turned[k] + at, &narrow, sizeof narrow);
        }
    }

    static KINORA_DUAL_INLINE void turn(const Matrix& m, const float* rest, float* out) {
        alignas(64) float rows[4][kLanes], columns[9][kLanes], turned[4][kLanes] = {};
        Floats n[4];
        read_rows(rest, n);
        std::memcpy(rows, n, sizeof rows);
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k)
                std::memcpy(columns[3 * c + k], &m.column[c][k], sizeof(Floats));
        turn_half(columns, rows, 0, turned);
        turn_half(columns, rows, V::kHalf, turned);
        std::memcpy(n, turned, sizeof n);
        n[3] = Floats{};
        write_rows(n, out);
    }

  public:
    template <bool kPositions, bool kNormals>
    static void blocks(const DeformTask& task, size_t begin_block, size_t end_block) {
        for (size_t block = begin_block; block < end_block; ++block) {
            const size_t first = task.first[block];
            const uint32_t rounds = uint32_t(task.first[block + 1] - first);
            const size_t at = (block - begin_block) * 4 * kDualBlock;
            for (uint32_t vertex = 0; vertex < kDualBlock; vertex += kLanes) {
                const Matrix m = blended(task.palette, task.weights + first * kDualBlock,
                                         task.offsets + first * kDualBlock, rounds, vertex);
                const size_t floats = at + 4 * vertex;
                if constexpr (kPositions)
                    move(m, task.rest_positions + floats, task.positions + floats);
                if constexpr (kNormals) turn(m, task.rest_normals + floats, task.normals + floats);
            }
        }
    }
};

template <int kLanes>
constexpr DeformKernel make_dual_kernel(const char* name) {
    using Kernel = DualKernel<kLanes>;
    return {name, Kernel::template blocks<true, true>, Kernel::template blocks<true, false>,
            Kernel::template blocks<false, true>};
}

}  // namespace
}  // namespace kinora::skin
