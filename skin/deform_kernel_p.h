// skin/deform_kernel_p.h: the skinning kernel, a template over an instruction set's vectors.
//
// A vector holds V::kLanes vertices of four floats each (x y z w). A joint matrix is four such
// columns, 64 bytes, so blending one vertex needs no gather: weight x matrix, whole. The blended
// matrices of kLanes vertices are then turned so that column c of all of them is one vector, which
// is also the layout of the output. Each step rounds as the portable version does: all instruction
// sets give the same bits.
#pragma once

#include "skin/deform_p.h"

namespace kinora::skin {
namespace {

constexpr uint32_t kBlock = 16;

// Columns 0..2 of the cofactor matrix, each with coordinates in the order z x y: V::yzx puts them
// right. (a x b = yzx(a * yzx(b) - yzx(a) * b).)
template <class V>
inline typename V::Vec cross_zxy(typename V::Vec a, typename V::Vec a_yzx, typename V::Vec b,
                                 typename V::Vec b_yzx) {
    return V::fnma(a_yzx, b, V::mul(a, b_yzx));
}

// n[group] = cofactor(blended) * rest, not yet unit; det[group] sums over its four floats to the
// determinant.
template <class V>
inline void transform_normal(const typename V::Vec c[4], const float* rest, typename V::Vec& n,
                             typename V::Vec& det) {
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
inline typename V::Vec transform_position(const typename V::Vec c[4], const float* rest) {
    auto x = V::load(rest);
    auto p = V::fma(c[0], V::template splat<0>(x), c[3]);
    p = V::fma(c[1], V::template splat<1>(x), p);
    return V::fma(c[2], V::template splat<2>(x), p);
}

// Scales four vectors of normals to unit length, right side out, and stores them. Returns a bit
// for each vertex whose numbers left float's safe range, in order of vertices.
template <class V>
inline uint32_t store_unit(const typename V::Vec n[4], const typename V::Vec det[4], float* out) {
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

// Bit (4 * lane + group) stands for vertex group * kLanes + lane.
template <class V>
inline void redo_normals(uint32_t outside, const float* palette, const float* weights,
                         const uint32_t* places, uint32_t rounds, const float* rest, float* out) {
    for (uint32_t bit = 0; bit < 4 * V::kLanes; ++bit) {
        if (!(outside >> bit & 1)) continue;
        uint32_t vertex = (bit % 4) * V::kLanes + bit / 4;
        exact_normal(palette, weights + vertex, places + vertex, rounds, rest + 4 * vertex,
                     out + 4 * vertex);
    }
}

template <class V, bool kPositions, bool kNormals>
void deform_blocks(const DeformTask& task, size_t begin_block, size_t end_block) {
    constexpr uint32_t kQuad = 4 * V::kLanes;  // vertices whose lengths share one square root
    size_t at = 0;                             // float offset of the vertices at hand
    for (size_t block = begin_block; block < end_block; ++block) {
        const uint32_t rounds = task.first[block + 1] - task.first[block];
        const float* weights = task.weights + size_t{task.first[block]} * kBlock;
        const uint32_t* places = task.places + size_t{task.first[block]} * kBlock;
        for (uint32_t quad = 0; quad < kBlock; quad += kQuad, at += 4 * kQuad) {
            typename V::Vec n[4], det[4];
            for (uint32_t group = 0; group < 4; ++group) {
                const uint32_t vertex = quad + group * V::kLanes;
                const size_t here = at + group * 4 * V::kLanes;
                typename V::Vec c[4];
                V::blend(task.palette, weights + vertex, places + vertex, rounds, c);
                if constexpr (kPositions)
                    V::store(task.positions + here,
                             transform_position<V>(c, task.rest_positions + here));
                if constexpr (kNormals)
                    transform_normal<V>(c, task.rest_normals + here, n[group], det[group]);
            }
            if constexpr (kNormals) {
                uint32_t outside = store_unit<V>(n, det, task.normals + at);
                if (outside) [[unlikely]]
                    redo_normals<V>(outside, task.palette, weights + quad, places + quad, rounds,
                                    task.rest_normals + at, task.normals + at);
            }
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
