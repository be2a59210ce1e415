// collada/number_lists.cpp: runs of short numbers, a whole number at a time.
#include <array>

#include "collada/number_reading_p.h"

namespace kinora::collada {

#ifdef __SSE2__

namespace {

constexpr int kBytes = 16;  // a word of this many at most

// From entry 16 - n on: 16 bytes of which the last n are set.
constexpr auto kLastBytes = [] {
    std::array<uint8_t, 3 * kBytes> t{};
    for (size_t i = kBytes; i < 2 * kBytes; ++i) t[i] = 0xFF;
    return t;
}();

__m128i load(const void* p) {
    return _mm_loadu_si128(static_cast<const __m128i*>(p));
}

__m128i last_bytes(int n) {
    return load(kLastBytes.data() + n);
}

unsigned bits(__m128i bytes) {
    return unsigned(_mm_movemask_epi8(bytes));
}

// 16 digits as a number: pairs, fours, then eight and eight.
uint64_t sixteen_digits(__m128i digits) {
    __m128i tens = _mm_and_si128(digits, _mm_set1_epi16(0xFF));
    __m128i pairs =
        _mm_add_epi16(_mm_mullo_epi16(tens, _mm_set1_epi16(10)), _mm_srli_epi16(digits, 8));
    __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(100 | 1 << 16));
    __m128i eights = _mm_madd_epi16(_mm_packs_epi32(fours, fours), _mm_set1_epi32(10000 | 1 << 16));
    uint64_t both = uint64_t(_mm_cvtsi128_si64(eights));
    return (both & 0xFFFFFFFFu) * 100000000 + (both >> 32);
}

}  // namespace

// The 16 bytes that end with the word hold its digits behind the point; the 16 that end one byte
// earlier hold those before it in the places they have without the point.
const char* read_short_doubles(const char* begin, const char* p, const char* end, double*& out) {
    const __m128i nought = _mm_set1_epi8('0'), nine = _mm_set1_epi8(9);
    while (end - p >= kScanReach) {
        if (is_number_space(*p)) {
            ++p;
            continue;
        }
        bool negative = *p == '-';
        const char* first = p + negative;
        __m128i word = load(first), value = _mm_sub_epi8(word, nought);
        unsigned space = bits(_mm_cmpeq_epi8(_mm_min_epu8(word, _mm_set1_epi8(' ')), word));
        unsigned inside = (space & -space) - 1;  // the bytes before the first space
        unsigned digit = bits(_mm_cmpeq_epi8(_mm_min_epu8(value, nine), value)) & inside;
        unsigned point = bits(_mm_cmpeq_epi8(word, _mm_set1_epi8('.'))) & inside;
        bool known = space && (digit | point) == inside && digit && !(point & (point - 1));
        if (!known || first - begin < kBytes) break;
        int length = std::countr_zero(space), count = length - (point != 0);
        int fraction = point ? length - 1 - std::countr_zero(point) : 0;
        const char* stop = first + length;
        // Without a point all digits count as those behind it.
        __m128i behind = last_bytes(point ? fraction : kBytes);
        __m128i digits = _mm_or_si128(_mm_and_si128(behind, load(stop - kBytes)),
                                      _mm_andnot_si128(behind, load(stop - kBytes - 1)));
        digits = _mm_and_si128(_mm_sub_epi8(digits, nought), last_bytes(count));
        uint64_t mantissa = sixteen_digits(digits);
        if (mantissa > uint64_t(1) << 53) break;
        // Clinger's case of scale_decimal().
        double magnitude = double(int64_t(mantissa)) / kExactPowersOfTen[fraction];
        *out++ =
            std::bit_cast<double>(std::bit_cast<uint64_t>(magnitude) | uint64_t(negative) << 63);
        p = stop + 1;  // white space stands at `stop`
    }
    return p;
}

#else

const char* read_short_doubles(const char*, const char* p, const char*, double*&) {
    return p;
}

#endif

const char* read_short_ints(const char* p, const char* end, int32_t*& out) {
    while (end - p >= kScanReach) {
        if (is_number_space(*p)) {
            ++p;
            continue;
        }
        uint64_t digits = scan::load_digits(p);
        int count = scan::digit_run(digits);
        if (count == 0 || !is_number_space(p[count])) break;
        *out++ = int32_t(scan::digits_value(digits, count));
        p += count + 1;
    }
    return p;
}

}  // namespace kinora::collada
