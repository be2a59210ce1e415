// tests/bench/hand_avx2.cpp: the hand-written shaders, 8 points at a time.
#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

#include "tests/bench/hand_surfaces_p.h"

namespace kinora::hand {
namespace {

struct Avx2 {
    using F = __m256;
    using I = __m256i;
    using M = __m256;
    static constexpr size_t kLanes = 8;

    static F set(float x) { return _mm256_set1_ps(x); }
    static I seti(int x) { return _mm256_set1_epi32(x); }
    static F load(const float* p) { return _mm256_load_ps(p); }
    static void store(float* p, F x) { _mm256_store_ps(p, x); }
    static F fma(F a, F b, F c) { return _mm256_fmadd_ps(a, b, c); }
    static F min(F a, F b) { return _mm256_min_ps(a, b); }
    static F max(F a, F b) { return _mm256_max_ps(a, b); }
    static F sqrt(F a) { return _mm256_sqrt_ps(a); }
    static F abs(F a) { return _mm256_andnot_ps(set(-0.0f), a); }
    static F floor(F a) { return _mm256_floor_ps(a); }
    static I truncate(F a) { return _mm256_cvttps_epi32(a); }
    static F to_float(I a) { return _mm256_cvtepi32_ps(a); }
    static I bits(F a) { return _mm256_castps_si256(a); }
    static F from_bits(I a) { return _mm256_castsi256_ps(a); }
    static I add(I a, I b) { return _mm256_add_epi32(a, b); }
    static I sub(I a, I b) { return _mm256_sub_epi32(a, b); }
    static I mul(I a, I b) { return _mm256_mullo_epi32(a, b); }
    static I bit_xor(I a, I b) { return _mm256_xor_si256(a, b); }
    static I bit_and(I a, I b) { return _mm256_and_si256(a, b); }
    template <int n>
    static I left(I a) {
        return _mm256_slli_epi32(a, n);
    }
    template <int n>
    static I right(I a) {
        return _mm256_srli_epi32(a, n);
    }
    template <int n>
    static I right_signed(I a) {
        return _mm256_srai_epi32(a, n);
    }
    static M less(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
    static M less_equal(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
    static M equal(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }
    static M either(M a, M b) { return _mm256_or_ps(a, b); }
    static F select(M m, F a, F b) { return _mm256_blendv_ps(b, a, m); }
    static F where(M m, F a) { return _mm256_and_ps(m, a); }  // else 0
    // table[i], 0 <= i < 8
    static F lookup(const float (&table)[8], I i) {
        return _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), i);
    }
    static bool any(M m) { return _mm256_movemask_ps(m) != 0; }
    static int which(M m) { return _mm256_movemask_ps(m); }
};

}  // namespace

const Shaders* avx2() {
    return &Hand<Avx2>::kShaders;
}

}  // namespace kinora::hand
#else
#include "tests/bench/hand_shaders.h"

namespace kinora::hand {
const Shaders* avx2() {
    return nullptr;
}
}  // namespace kinora::hand
#endif
