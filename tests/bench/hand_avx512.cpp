// tests/bench/hand_avx512.cpp: the hand-written shaders, 16 points at a time.
#ifdef __AVX512F__
#include <immintrin.h>

#include "tests/bench/hand_surfaces_p.h"

namespace kinora::hand {
namespace {

struct Avx512 {
    using F = __m512;
    using I = __m512i;
    using M = __mmask16;
    static constexpr size_t kLanes = 16;

    static F set(float x) { return _mm512_set1_ps(x); }
    static I seti(int x) { return _mm512_set1_epi32(x); }
    static F load(const float* p) { return _mm512_load_ps(p); }
    static void store(float* p, F x) { _mm512_store_ps(p, x); }
    static F fma(F a, F b, F c) { return _mm512_fmadd_ps(a, b, c); }
    static F min(F a, F b) { return _mm512_min_ps(a, b); }
    static F max(F a, F b) { return _mm512_max_ps(a, b); }
    static F sqrt(F a) { return _mm512_sqrt_ps(a); }
    static F abs(F a) { return _mm512_abs_ps(a); }
    static F floor(F a) { return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEG_INF); }
    static I truncate(F a) { return _mm512_cvttps_epi32(a); }
    static F to_float(I a) { return _mm512_cvtepi32_ps(a); }
    static I bits(F a) { return _mm512_castps_si512(a); }
    static F from_bits(I a) { return _mm512_castsi512_ps(a); }
    static I add(I a, I b) { return _mm512_add_epi32(a, b); }
    static I sub(I a, I b) { return _mm512_sub_epi32(a, b); }
    static I mul(I a, I b) { return _mm512_mullo_epi32(a, b); }
    static I bit_xor(I a, I b) { return _mm512_xor_si512(a, b); }
    static I bit_and(I a, I b) { return _mm512_and_si512(a, b); }
    template <int n>
    static I left(I a) {
        return _mm512_slli_epi32(a, n);
    }
    template <int n>
    static I right(I a) {
        return _mm512_srli_epi32(a, n);
    }
    template <int n>
    static I right_signed(I a) {
        return _mm512_srai_epi32(a, n);
    }
    static M less(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static M less_equal(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static M equal(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
    static M either(M a, M b) { return M(a | b); }
    static F select(M m, F a, F b) { return _mm512_mask_blend_ps(m, b, a); }
    static F where(M m, F a) { return _mm512_maskz_mov_ps(m, a); }  // else 0
    // table[i], 0 <= i < 8
    static F lookup(const float (&table)[8], I i) {
        return _mm512_permutexvar_ps(i, _mm512_broadcast_f32x8(_mm256_loadu_ps(table)));
    }
    static bool any(M m) { return m != 0; }
    static int which(M m) { return m; }
};

}  // namespace

const Shaders* avx512() {
    return &Hand<Avx512>::kShaders;
}

}  // namespace kinora::hand
#else
#include "tests/bench/hand_shaders.h"

namespace kinora::hand {
const Shaders* avx512() {
    return nullptr;
}
}  // namespace kinora::hand
#endif
