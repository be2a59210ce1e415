// collada/text/number_lists.cpp: runs of short numbers, a whole number at a time.
#include <algorithm>
#include <array>
#include <cstddef>

#include "collada/text/number_reading_p.h"

namespace kinora::collada {

#ifdef __SSE2__

namespace {

constexpr std::ptrdiff_t kBytes = 16;  // a word with its space is so long at most

// From entry 16 - n on: 16 bytes of which the last n are set.
constexpr auto kLastBytes = [] {
    std::array<uint8_t, 3 * kBytes> t{};
    for (std::ptrdiff_t i = kBytes; i < 2 * kBytes; ++i) t[size_t(i)] = 0xFF;
    return t;
}();

__m128i load(const void* p) {
    return _mm_loadu_si128(static_cast<const __m128i*>(p));
}

__m128i last_bytes(std::ptrdiff_t n) {
    return load(kLastBytes.data() + n);
}

unsigned bits(__m128i bytes) {
    return unsigned(_mm_movemask_epi8(bytes));
}

// 16 digits as a number: pairs, fours, then eight and eight.
uint64_t sixteen_digits(__m128i digits) {
    // tens + 256 ones, times 2561, is tens + 256 (10 tens + ones) in the 16 bits that are kept.
    __m128i pairs = _mm_srli_epi16(_mm_mullo_epi16(digits, _mm_set1_epi16(2561)), 8);
    __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(100 | 1 << 16));
    __m128i eights = _mm_madd_epi16(_mm_packs_epi32(fours, fours), _mm_set1_epi32(10000 | 1 << 16));
    uint64_t both = uint64_t(_mm_cvtsi128_si64(eights));
    return (both & 0xFFFFFFFFu) * 100000000 + (both >> 32);
}

}  // namespace

// The 16 bytes that end with the word hold its digits behind the point; the 16 that end one byte
// earlier hold those before it at the positions they have without the point. A word without a point
// has it where the space is.
const char* read_short_doubles(const char* begin, const char* p, const char* end, double*& out) {
    if (p - begin < kBytes || end - p < kScanReach) return p;
    const __m128i nought = _mm_set1_epi8('0'), nine = _mm_set1_epi8(9);
    double* next = out;
    for (const char* last = end - kScanReach; p <= last;) {
        if (is_number_space(*p)) {
            ++p;
            continue;
        }
        __m128i word = load(p);
        unsigned space = bits(_mm_cmpeq_epi8(_mm_min_epu8(word, _mm_set1_epi8(' ')), word));
        unsigned point = bits(_mm_cmpeq_epi8(word, _mm_set1_epi8('.')));
        if (space == 0) break;
        std::ptrdiff_t length = std::countr_zero(space), before = std::countr_zero(space | point);
        std::ptrdiff_t stop = std::max(length, before + 1), fraction = stop - 1 - before;
        bool negative = *p == '-';
        std::ptrdiff_t count = stop - 1 - negative;
        if (count == 0) break;
        __m128i behind = last_bytes(fraction);
        __m128i digits = _mm_or_si128(_mm_and_si128(behind, load(p + stop - kBytes)),
                                      _mm_andnot_si128(behind, load(p + stop - kBytes - 1)));
        digits = _mm_and_si128(_mm_sub_epi8(digits, nought), last_bytes(count));
        if (bits(_mm_cmpeq_epi8(_mm_min_epu8(digits, nine), digits)) != 0xFFFF) break;
        // Both are exact as doubles (15 digits are below 2^53), so one division rounds once.
        double magnitude = double(int64_t(sixteen_digits(digits))) / kExactPowersOfTen[fraction];
        *next++ =
            std::bit_cast<double>(std::bit_cast<uint64_t>(magnitude) | uint64_t(negative) << 63);
        p += length + 1;
    }
    out = next;
    return p;
}

#else

const char* read_short_doubles(const char*, const char* p, const char*, double*&) {
    return p;
}

#endif

const char* read_short_ints(const char* p, const char* end, int32_t*& out) {
    if (end - p < kScanReach) return p;
    int32_t* next = out;
    for (const char* last = end - kScanReach; p <= last;) {
        if (is_number_space(*p)) {
            ++p;
            continue;
        }
        uint64_t digits = scan::load_digits(p);
        int count = scan::digit_run(digits);
        if (count == 0 || !is_number_space(p[count])) break;
        *next++ = int32_t(scan::digits_value(digits, count));
        p += count + 1;
    }
    out = next;
    return p;
}

}  // namespace kinora::collada
