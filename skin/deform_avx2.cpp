// skin/deform_avx2.cpp: the skinning kernel for AVX2 and FMA, two vertices a vector.
#include <immintrin.h>

#include "skin/deform_kernel_p.h"

namespace kinora::skin {
namespace {

struct Avx2 {
    static constexpr uint32_t kLanes = 2;
    using Vec = __m256;
    static Vec load(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, Vec a) { _mm256_storeu_ps(p, a); }
    static Vec set(float v) { return _mm256_set1_ps(v); }
    static Vec mul(Vec a, Vec b) { return _mm256_mul_ps(a, b); }
    static Vec fma(Vec a, Vec b, Vec c) { return _mm256_fmadd_ps(a, b, c); }
    static Vec fnma(Vec a, Vec b, Vec c) { return _mm256_fnmadd_ps(a, b, c); }
    static Vec sqrt(Vec a) { return _mm256_sqrt_ps(a); }
    static Vec div(Vec a, Vec b) { return _mm256_div_ps(a, b); }
    static Vec copysign(Vec a, Vec b) {
        Vec sign = set(-0.0f);
        return _mm256_or_ps(_mm256_andnot_ps(sign, a), _mm256_and_ps(sign, b));
    }
    static Vec yzx(Vec a) { return _mm256_permute_ps(a, _MM_SHUFFLE(3, 0, 2, 1)); }
    template <int I>
    static Vec splat(Vec a) {
        return _mm256_permute_ps(a, _MM_SHUFFLE(I, I, I, I));
    }
    // In each lane: the sums of a's, b's, c's and d's four floats, as (f0 + f2) + (f1 + f3).
    static Vec transpose_sum(Vec a, Vec b, Vec c, Vec d) {
        Vec ab = _mm256_add_ps(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        Vec cd = _mm256_add_ps(_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        return _mm256_add_ps(_mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0)),
                             _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2)));
    }
    static Vec safe(Vec a) {
        return _mm256_and_ps(_mm256_cmp_ps(a, set(kLeastSafe), _CMP_GE_OQ),
                             _mm256_cmp_ps(a, set(kMostSafe), _CMP_LE_OQ));
    }
    static uint32_t outside(Vec square, Vec det) {
        Vec size = _mm256_andnot_ps(set(-0.0f), det);
        return ~_mm256_movemask_ps(_mm256_and_ps(safe(square), safe(size))) & 0xff;
    }
    using Weights = const float*;  // broadcast from memory: loads are spare here, shuffles are not
    static Weights weights(const float* p) { return p; }
    template <int I>
    static Vec weight(Weights w) {
        return _mm256_broadcast_ss(w + I);
    }
    // c[i] = column i of the two matrices (m[0], m[1]) and (m[2], m[3]).
    static void transpose_lanes(const Vec m[4], Vec c[4]) {
        c[0] = _mm256_permute2f128_ps(m[0], m[2], 0x20);
        c[1] = _mm256_permute2f128_ps(m[0], m[2], 0x31);
        c[2] = _mm256_permute2f128_ps(m[1], m[3], 0x20);
        c[3] = _mm256_permute2f128_ps(m[1], m[3], 0x31);
    }
};

}  // namespace

extern const DeformKernel kAvx2Kernel = make_kernel<Avx2>("avx2");

}  // namespace kinora::skin
