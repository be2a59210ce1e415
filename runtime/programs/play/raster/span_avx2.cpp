// runtime/programs/play/raster/span_avx2.cpp: the span kernels for AVX2, eight pixels at a time.
#include <immintrin.h>

#include "runtime/programs/play/raster/span_kernel_p.h"

namespace kinora::play {
namespace {

struct Avx2 {
    static constexpr int kLanes = 8;
    using Int = __m256i;
    using Float = __m256;
    static Int set(int32_t v) { return _mm256_set1_epi32(v); }
    static Int iota() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
    static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
    static Int sub(Int a, Int b) { return _mm256_sub_epi32(a, b); }
    static Int mul(Int a, Int b) { return _mm256_mullo_epi32(a, b); }
    static Int min(Int a, Int b) { return _mm256_min_epi32(a, b); }
    static Int max(Int a, Int b) { return _mm256_max_epi32(a, b); }
    static Int bits_and(Int a, Int b) { return _mm256_and_si256(a, b); }
    static Int bits_or(Int a, Int b) { return _mm256_or_si256(a, b); }
    template <int kBits>
    static Int shift_left(Int a) {
        return _mm256_slli_epi32(a, kBits);
    }
    template <int kBits>
    static Int shift_right(Int a) {
        return _mm256_srli_epi32(a, kBits);
    }
    template <int kBits>
    static Int shift_signed(Int a) {
        return _mm256_srai_epi32(a, kBits);
    }
    static Float setf(float v) { return _mm256_set1_ps(v); }
    static Float addf(Float a, Float b) { return _mm256_add_ps(a, b); }
    static Float mulf(Float a, Float b) { return _mm256_mul_ps(a, b); }
    static Float to_float(Int a) { return _mm256_cvtepi32_ps(a); }
    static Int round(Float a) { return _mm256_cvtps_epi32(a); }
    // A gather of words would read past the last byte.
    static Int gather8(const uint8_t* base, Int index) {
        alignas(32) int32_t at[kLanes];
        _mm256_store_si256(reinterpret_cast<__m256i*>(at), index);
        return _mm256_setr_epi32(base[at[0]], base[at[1]], base[at[2]], base[at[3]], base[at[4]],
                                 base[at[5]], base[at[6]], base[at[7]]);
    }
    static Int gather32(const uint8_t* base, Int index) {
        return _mm256_i32gather_epi32(reinterpret_cast<const int*>(base), index, 4);
    }
    static Int load8(const uint8_t* p, int count) {
        if (count == kLanes)
            return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
        uint64_t bytes = 0;
        for (int i = 0; i < count; ++i) bytes |= static_cast<uint64_t>(p[i]) << (8 * i);
        return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bytes)));
    }
    static Int load(const uint32_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    static void store(uint32_t* p, Int a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a); }
    static Int first(int count) { return _mm256_cmpgt_epi32(set(count), iota()); }
    static Int load_some(const uint32_t* p, int count) {
        return _mm256_maskload_epi32(reinterpret_cast<const int*>(p), first(count));
    }
    static void store_some(uint32_t* p, int count, Int a) {
        _mm256_maskstore_epi32(reinterpret_cast<int*>(p), first(count), a);
    }
};

}  // namespace

extern const SpanKernel kAvx2Spans = make_spans<Avx2>("avx2");

}  // namespace kinora::play
