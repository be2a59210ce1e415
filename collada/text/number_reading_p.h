// collada/text/number_reading_p.h: one number of a list, eight digits at a time.
//
// A byte of a word of eight is a digit when it is 0..9 after xor with '0'; the run of digits is
// shifted to the word's top, which puts zeros before it, and summed in three multiplications.
// Numbers of up to 19 digits and a small power of ten, nearly all there are, become the nearest
// double by one division; what is longer is left to std::from_chars.
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

inline constexpr uint64_t kPowersOfTen[] = {1,      10,      100,      1000,     10000,
                                            100000, 1000000, 10000000, 100000000};

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

// Adds up to 24 digits to `value` and `count`; the end. Beyond 19 digits `value` is of no use.
inline const char* take_digits(const char* p, uint64_t& value, int& count) {
    for (int word = 0; word < 3; ++word) {
        uint64_t digits = load_digits(p);
        int run = digit_run(digits);
        if (run == 0) break;
        value = value * kPowersOfTen[run] + digits_value(digits, run);
        count += run;
        p += run;
        if (run < 8) break;
    }
    return p;
}

}  // namespace scan

inline constexpr double kExactPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// The rest of scale_decimal.
bool scale_long_decimal(uint64_t mantissa, int exponent, double& value);

// The double nearest to mantissa * 10^exponent; false when that is not among the easy cases.
inline bool scale_decimal(uint64_t mantissa, int exponent, double& value) {
    // Clinger's case: both are exact as doubles, so one operation rounds once.
    if (mantissa <= uint64_t(1) << 53 && exponent >= -22 && exponent <= 22) {
        double m = double(int64_t(mantissa));
        value = exponent < 0 ? m / kExactPowersOfTen[-exponent] : m * kExactPowersOfTen[exponent];
        return true;
    }
    return scale_long_decimal(mantissa, exponent, value);
}

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

// Reads the number that [p, stop) is. False: it may be one all the same. kScanReach bytes from `p`
// on must be readable.
inline bool scan_double(const char* p, const char* stop, double& value) {
    bool negative = *p == '-';
    p += negative;
    uint64_t mantissa = 0;
    int digits = 0, exponent = 0;
    p = scan::take_digits(p, mantissa, digits);
    if (*p == '.') {
        int before = digits;
        p = scan::take_digits(p + 1, mantissa, digits);
        exponent = before - digits;
    }
    if (digits == 0 || digits > 19) return false;
    if ((*p | 32) == 'e') {
        bool down = p[1] == '-';
        p += 1 + (down || p[1] == '+');
        uint64_t power = scan::load_digits(p);
        int run = scan::digit_run(power);
        if (run == 0 || run > 4) return false;
        power = scan::digits_value(power, run);
        exponent += down ? -int(power) : int(power);
        p += run;
    }
    if (p != stop || !scale_decimal(mantissa, exponent, value)) return false;
    value = std::bit_cast<double>(std::bit_cast<uint64_t>(value) | uint64_t(negative) << 63);
    return true;
}

// The same for whole numbers of up to eight digits.
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
