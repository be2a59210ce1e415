// skin/deform_avx512.cpp: the skinning kernel for AVX-512, four vertices a vector.
#include <immintrin.h>

#include "skin/deform_kernel_p.h"

namespace kinora::skin {
namespace {

struct Avx512 {
    static constexpr uint32_t kLanes = 4;
    using Vec = __m512;
    static Vec load(const float* p) { return _mm512_loadu_ps(p); }
    static void store(float* p, Vec a) { _mm512_storeu_ps(p, a); }
    static Vec set(float v) { return _mm512_set1_ps(v); }
    static Vec mul(Vec a, Vec b) { return _mm512_mul_ps(a, b); }
    static Vec fma(Vec a, Vec b, Vec c) { return _mm512_fmadd_ps(a, b, c); }
    static Vec fnma(Vec a, Vec b, Vec c) { return _mm512_fnmadd_ps(a, b, c); }
    static Vec sqrt(Vec a) { return _mm512_sqrt_ps(a); }
    static Vec div(Vec a, Vec b) { return _mm512_div_ps(a, b); }
    static Vec copysign(Vec a, Vec b) {
        constexpr int kSelect = 0xac;  // truth table of mask ? b : a
        return _mm512_castsi512_ps(_mm512_ternarylogic_epi32(
            _mm512_set1_epi32(INT32_MIN), _mm512_castps_si512(a), _mm512_castps_si512(b), kSelect));
    }
    static Vec yzx(Vec a) { return _mm512_permute_ps(a, _MM_SHUFFLE(3, 0, 2, 1)); }
    template <int I>
    static Vec splat(Vec a) {
        return _mm512_permute_ps(a, _MM_SHUFFLE(I, I, I, I));
    }
    // In each lane: the sums of a's, b's, c's and d's four floats, as (f0 + f2) + (f1 + f3).
    static Vec transpose_sum(Vec a, Vec b, Vec c, Vec d) {
        Vec ab = _mm512_add_ps(_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        Vec cd = _mm512_add_ps(_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        return _mm512_add_ps(_mm512_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0)),
                             _mm512_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2)));
    }
    static __mmask16 safe(Vec a) {
        return _mm512_cmp_ps_mask(a, set(kLeastSafe), _CMP_GE_OQ) &
               _mm512_cmp_ps_mask(a, set(kMostSafe), _CMP_LE_OQ);
    }
    static uint32_t outside(Vec square, Vec det) {
        return ~(safe(square) & safe(_mm512_abs_ps(det))) & 0xffffu;
    }
    using Weights = Vec;  // four weights, once a lane: shuffles are spare here, loads are not
    static Weights weights(const float* p) { return _mm512_broadcast_f32x4(_mm_loadu_ps(p)); }
    template <int I>
    static Vec weight(Weights w) {
        return splat<I>(w);
    }
    // c[i] = column i of the four matrices m.
    static void transpose_lanes(const Vec m[4], Vec c[4]) {
        Vec m01_low = _mm512_shuffle_f32x4(m[0], m[1], _MM_SHUFFLE(1, 0, 1, 0));
        Vec m01_high = _mm512_shuffle_f32x4(m[0], m[1], _MM_SHUFFLE(3, 2, 3, 2));
        Vec m23_low = _mm512_shuffle_f32x4(m[2], m[3], _MM_SHUFFLE(1, 0, 1, 0));
        Vec m23_high = _mm512_shuffle_f32x4(m[2], m[3], _MM_SHUFFLE(3, 2, 3, 2));
        c[0] = _mm512_shuffle_f32x4(m01_low, m23_low, _MM_SHUFFLE(2, 0, 2, 0));
        c[1] = _mm512_shuffle_f32x4(m01_low, m23_low, _MM_SHUFFLE(3, 1, 3, 1));
        c[2] = _mm512_shuffle_f32x4(m01_high, m23_high, _MM_SHUFFLE(2, 0, 2, 0));
        c[3] = _mm512_shuffle_f32x4(m01_high, m23_high, _MM_SHUFFLE(3, 1, 3, 1));
    }
};

}  // namespace

extern const DeformKernel kAvx512Kernel = make_kernel<Avx512>("avx512");

}  // namespace kinora::skin
