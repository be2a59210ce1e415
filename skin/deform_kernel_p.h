// skin/deform_kernel_p.h: the skinning kernel, a template over an instruction set's vectors.
//
// A vector holds V::kLanes vertices of four floats each (x y z w). A joint matrix is four such
// columns, 64 bytes, so blending needs no gather: weight x matrix, whole. The blended matrices of
// kLanes vertices are then turned so that column c of all of them is one vector, which is also the
// layout of the output. Each step rounds as the portable version does, with no instruction whose
// result differs between makers: all instruction sets give the same bits.
#pragma once

#include "skin/deform_p.h"

// Vectors must stay in registers across these steps, at every optimisation level that matters.
#define KINORA_INLINE __attribute__((always_inline)) inline

namespace kinora::skin {
namespace {

constexpr uint32_t kBlock = 16;

// acc = or += weight * matrix by influence k of kLanes vertices. A vertex's matrix fills 4 / kLanes
// vectors; w[v] stands for the vertex's weights of this set.
template <class V, uint32_t kSet, uint32_t k, bool kFirst>
KINORA_INLINE void add_influence(const float* palette, const uint32_t* offsets,
                                 const typename V::Weights* w, typename V::Vec acc[4]) {
    constexpr uint32_t kParts = 4 / V::kLanes;
#pragma GCC unroll 4
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t vertex = i / kParts, part = i % kParts;
        const float* matrix = palette + offsets[vertex * kSet + k];
        const auto m = V::load(matrix + part * 4 * V::kLanes);
        const auto weight = V::template weight<k>(w[vertex]);
        acc[i] = kFirst ? V::mul(m, weight) : V::fma(m, weight, acc[i]);
    }
}

// One set of 1..4 influences; `weights` and `offsets` are at the first of the kLanes vertices.
template <class V, uint32_t kSet, bool kFirst>
KINORA_INLINE void add_set(const float* palette, const float* weights, const uint32_t* offsets,
                           typename V::Vec acc[4]) {
    typename V::Weights w[V::kLanes];
#pragma GCC unroll 4
    for (uint32_t v = 0; v < V::kLanes; ++v) w[v] = V::weights(weights + v * kSet);
    add_influence<V, kSet, 0, kFirst>(palette, offsets, w, acc);
    if constexpr (kSet > 1) add_influence<V, kSet, 1, false>(palette, offsets, w, acc);
    if constexpr (kSet > 2) add_influence<V, kSet, 2, false>(palette, offsets, w, acc);
    if constexpr (kSet > 3) add_influence<V, kSet, 3, false>(palette, offsets, w, acc);
}

// Columns c[0..3] of the blended matrices of vertices vertex .. vertex + kLanes - 1 of a block.
// kRounds: the block's rounds if at most four, else 0.
template <class V, uint32_t kRounds>
KINORA_INLINE void blend(const float* palette, const float* weights, const uint32_t* offsets,
                         uint32_t rounds, uint32_t vertex, typename V::Vec c[4]) {
    typename V::Vec acc[4];
    constexpr uint32_t kSet = kRounds ? kRounds : 4;
    add_set<V, kSet, true>(palette, weights + vertex * kSet, offsets + vertex * kSet, acc);
    if constexpr (kRounds == 0) {
        for (uint32_t done = 4; done < rounds; done += 4) {
            const float* w = weights + done * kBlock;
            const uint32_t* p = offsets + done * kBlock;
            switch (rounds - done) {
                case 1:
                    add_set<V, 1, false>(palette, w + vertex, p + vertex, acc);
                    break;
                case 2:
                    add_set<V, 2, false>(palette, w + vertex * 2, p + vertex * 2, acc);
                    break;
                case 3:
                    add_set<V, 3, false>(palette, w + vertex * 3, p + vertex * 3, acc);
                    break;
                default:
                    add_set<V, 4, false>(palette, w + vertex * 4, p + vertex * 4, acc);
                    break;
            }
        }
    }
    V::transpose_lanes(acc, c);
}

// Columns 0..2 of the cofactor matrix, each with coordinates in the order z x y: V::yzx puts them
// right. (a x b = yzx(a * yzx(b) - yzx(a) * b).)
template <class V>
KINORA_INLINE typename V::Vec cross_zxy(typename V::Vec a, typename V::Vec a_yzx, typename V::Vec b,
                                        typename V::Vec b_yzx) {
    return V::fnma(a_yzx, b, V::mul(a, b_yzx));
}

// n[group] = cofactor(blended) * rest, not yet unit; det[group] sums over its four floats to the
// determinant.
template <class V>
KINORA_INLINE void transform_normal(const typename V::Vec c[4], const float* rest,
                                    typename V::Vec& n, typename V::Vec& det) {
    auto r0 = V::yzx(c[0]), r1 = V::yzx(c[1]), r2 = V::yzx(c[2]);
    auto k0 = cross_zxy<V>(c[1], r1, c[2], r2);
    auto k1 = cross_zxy<V>(c[2], r2, c[0], r0);
    auto k2 = cross_zxy<V>(c[0], r0, c[1], r1);
    auto x = V::load(rest);
    auto sum = V::mul(k0, V::template splat<0>(x));
    sum = V::fma(k1, V::template splat<1>(x), sum);
    sum = V::fma(k2, V::template splat<2>(x), sum);
    n = V::yzx(sum);
    det = V::mul(V::yzx(k0), c[0]);
}

template <class V>
KINORA_INLINE typename V::Vec transform_position(const typename V::Vec c[4], const float* rest) {
    auto x = V::load(rest);
    auto p = V::fma(c[0], V::template splat<0>(x), c[3]);
    p = V::fma(c[1], V::template splat<1>(x), p);
    return V::fma(c[2], V::template splat<2>(x), p);
}

// Scales four vectors of normals to unit length, right side out, and stores them. Returns a bit
// for each vertex whose numbers left float's safe range, in order of vertices.
template <class V>
KINORA_INLINE uint32_t store_unit(const typename V::Vec n[4], const typename V::Vec det[4],
                                  float* out) {
    auto square = V::transpose_sum(V::mul(n[0], n[0]), V::mul(n[1], n[1]), V::mul(n[2], n[2]),
                                   V::mul(n[3], n[3]));
    auto determinant = V::transpose_sum(det[0], det[1], det[2], det[3]);
    auto scale = V::copysign(V::div(V::set(1.0f), V::sqrt(square)), determinant);
    constexpr uint32_t kFloats = 4 * V::kLanes;
    V::store(out + 0 * kFloats, V::mul(n[0], V::template splat<0>(scale)));
    V::store(out + 1 * kFloats, V::mul(n[1], V::template splat<1>(scale)));
    V::store(out + 2 * kFloats, V::mul(n[2], V::template splat<2>(scale)));
    V::store(out + 3 * kFloats, V::mul(n[3], V::template splat<3>(scale)));
    return V::outside(square, determinant);
}

// Where one block's vertices lie in the task's arrays.
struct BlockView {
    const float* palette;
    const float* weights;
    const uint32_t* offsets;
    uint32_t rounds;
    const float* rest_positions;
    const float* rest_normals;
    float* positions;
    float* normals;
};

// Bit (4 * lane + group) of `outside` stands for vertex quad + group * kLanes + lane.
template <class V>
KINORA_INLINE void redo_normals(uint32_t outside, const BlockView& b, uint32_t quad) {
    for (uint32_t bit = 0; bit < 4 * V::kLanes; ++bit) {
        if (!(outside >> bit & 1)) continue;
        const uint32_t vertex = quad + (bit % 4) * V::kLanes + bit / 4;
        exact_normal(b.palette, b.weights, b.offsets, b.rounds, vertex, b.rest_normals + 4 * vertex,
                     b.normals + 4 * vertex);
    }
}

// kRounds: the block's rounds where known to the compiler, else 0.
template <class V, bool kPositions, bool kNormals, uint32_t kRounds>
KINORA_INLINE void deform_block(const BlockView& b) {
    constexpr uint32_t kQuad = 4 * V::kLanes;  // vertices whose lengths share one square root
    for (uint32_t quad = 0; quad < kBlock; quad += kQuad) {
        typename V::Vec n[4], det[4];
#pragma GCC unroll 4
        for (uint32_t group = 0; group < 4; ++group) {
            const uint32_t vertex = quad + group * V::kLanes;
            typename V::Vec c[4];
            blend<V, kRounds>(b.palette, b.weights, b.offsets, b.rounds, vertex, c);
            if constexpr (kPositions)
                V::store(b.positions + 4 * vertex,
                         transform_position<V>(c, b.rest_positions + 4 * vertex));
            if constexpr (kNormals)
                transform_normal<V>(c, b.rest_normals + 4 * vertex, n[group], det[group]);
        }
        if constexpr (kNormals) {
            uint32_t outside = store_unit<V>(n, det, b.normals + 4 * quad);
            if (outside) [[unlikely]]
                redo_normals<V>(outside, b, quad);
        }
    }
}

template <class V, bool kPositions, bool kNormals>
void deform_blocks(const DeformTask& task, size_t begin_block, size_t end_block) {
    for (size_t block = begin_block; block < end_block; ++block) {
        const size_t first = task.first[block], at = (block - begin_block) * 4 * kBlock;
        const BlockView view{task.palette,
                             task.weights + first * kBlock,
                             task.offsets + first * kBlock,
                             static_cast<uint32_t>(task.first[block + 1] - first),
                             task.rest_positions + at,
                             task.rest_normals + at,
                             task.positions + at,
                             task.normals + at};
        switch (view.rounds) {  // the common counts as straight code
            case 1:
                deform_block<V, kPositions, kNormals, 1>(view);
                break;
            case 2:
                deform_block<V, kPositions, kNormals, 2>(view);
                break;
            case 3:
                deform_block<V, kPositions, kNormals, 3>(view);
                break;
            case 4:
                deform_block<V, kPositions, kNormals, 4>(view);
                break;
            default:
                deform_block<V, kPositions, kNormals, 0>(view);
                break;
        }
    }
}

template <class V>
constexpr DeformKernel make_kernel(const char* name) {
    return {name, deform_blocks<V, true, true>, deform_blocks<V, true, false>,
            deform_blocks<V, false, true>};
}

}  // namespace
}  // namespace kinora::skin
