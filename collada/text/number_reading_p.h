// collada/text/number_reading_p.h: the usual short numbers of a list.
//
// A byte of a word of eight is a digit when it is 0..9 after xor with '0'; the run of digits is
// shifted to the word's top, which puts zeros before it, and summed in three multiplications.
// What is longer is left to fast_float.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace kinora::collada {

// Scanning may look at this many bytes from a number's first on.
inline constexpr int kScanReach = 80;

// XML knows no other characters up to the space.
inline bool is_number_space(char c) {
    return uint8_t(c) <= ' ';
}

namespace scan {

// Eight bytes as digits, the first in the lowest byte; others than digits are above 9.
inline uint64_t load_digits(const char* p) {
    uint64_t word;
    std::memcpy(&word, p, 8);
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
    return word ^ 0x3030303030303030u;
}

// How many digits stand before the first byte that is none. A carry only reaches bytes behind it.
inline int digit_run(uint64_t digits) {
    uint64_t others = ((digits + 0x7676767676767676u) | digits) & 0x8080808080808080u;
    return others ? std::countr_zero(others) / 8 : 8;
}

// The first `count` (1 to 8) digits as a number: pairs, then fours, then all.
inline uint64_t digits_value(uint64_t digits, int count) {
    digits <<= 64 - 8 * count;
    digits = digits * 10 + (digits >> 8);  // bytes 0, 2, 4, 6 are pairs
    constexpr uint64_t kPairs = 0x000000FF000000FFu;
    uint64_t high = (digits & kPairs) * (100 + (uint64_t(1000000) << 32));
    uint64_t low = ((digits >> 16) & kPairs) * (1 + (uint64_t(10000) << 32));
    return (high + low) >> 32;
}

}  // namespace scan

inline constexpr double kExactPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// The bytes before the first space, looking at 16 of them: 16 when there is none. Found before
// anything is read, so that the work on one number and the search for the next overlap.
inline int solid_run(const char* p) {
#ifdef __SSE2__
    __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
    __m128i spaces = _mm_cmpeq_epi8(_mm_min_epu8(bytes, _mm_set1_epi8(' ')), bytes);
    return std::countr_zero(unsigned(_mm_movemask_epi8(spaces)) | 0x10000u);
#else
    int run = 0;
    while (run < 16 && !is_number_space(p[run])) ++run;
    return run;
#endif
}

// Reads the whole number of up to eight digits that [p, stop) is. False: it may be one all the
// same. kScanReach bytes from `p` on must be readable.
inline bool scan_int(const char* p, const char* stop, int32_t& value) {
    bool negative = *p == '-';
    p += negative;
    uint64_t digits = scan::load_digits(p);
    int run = scan::digit_run(digits);
    if (run == 0 || p + run != stop) return false;
    value = int32_t(scan::digits_value(digits, run));
    value = negative ? -value : value;
    return true;
}

// Read words from p on while they are of the usual short forms and far from the end, where
// kScanReach bytes are readable: [-]digits[.digits] with up to 16 bytes (and from the 16th byte of
// [begin, end) on), or up to eight digits. Return where they stop, which may be before white space.
const char* read_short_doubles(const char* begin, const char* p, const char* end, double*& out);
const char* read_short_ints(const char* p, const char* end, int32_t*& out);

}  // namespace kinora::collada
