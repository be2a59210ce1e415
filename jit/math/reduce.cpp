// jit/math/reduce.cpp: huge angles modulo pi/2, exactly, in integers (Payne and Hanek 1983).
//
// |x| = m 2^e with a 24-bit m. x 2/pi modulo 4 needs only a window of the digits of 2/pi: digits
// worth 4 or more after the shift by e add multiples of 4. Digits have 14 bits, so that a sum of
// three 14 x 14 bit products fits in 31. With e + 14 = 14 q + s, m 2^s has three digits, and the
// window starts at digit q - 2 of 2/pi. Eight digits leave 2^-61; the smallest remainder that a
// float can have is about 2^-30.
#include "jit/math/reduce_p.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "jit/math/coefficients_p.h"

namespace kinora::jit::math {
namespace {

constexpr int kDigitBits = 14;
constexpr int kDigitMask = (1 << kDigitBits) - 1;
constexpr int kWindow = 8;
constexpr int kMaxShift = 8;  // of q, reached by infinities only
constexpr int kTable = kMaxShift + kWindow;

// Digit i of 2/pi, counted from two zeros before the first.
int32_t padded_digit(int i) {
    return i < 2 ? 0 : kTwoOverPiDigits[i - 2];
}

// Digits q .. q + kWindow - 1 of the table: a shift by each bit of q in turn.
std::array<Int, kWindow> digit_window(Int q) {
    std::vector<Int> digits;
    for (int i = 0; i < kTable; ++i) digits.push_back(integer(q, padded_digit(i)));
    for (int bit = 3; bit >= 0; --bit) {
        Mask shift = bit_set(q, bit);
        size_t step = size_t{1} << bit;
        size_t kept = kWindow + step - 1;
        for (size_t i = 0; i < kept && i + step < digits.size(); ++i)
            digits[i] = select(shift, digits[i + step], digits[i]);
    }
    std::array<Int, kWindow> window;
    std::copy_n(digits.begin(), kWindow, window.begin());
    return window;
}

// The digits of m 2^s, lowest first; 0 <= s < 14.
std::array<Int, 3> shifted_mantissa(Int m, Int s) {
    Int power = truncate(from_bits((s + 127) << 23));
    Int low = (m & kDigitMask) * power;
    Int high = shift_right(m, kDigitBits) * power + shift_right(low, kDigitBits);
    return {low & kDigitMask, high & kDigitMask, shift_right(high, kDigitBits)};
}

// The product's digits worth 1, 2^-14, ... 2^-84, each in [-2^13, 2^13) but the first: balanced, so
// that no leading digits cancel.
std::array<Int, 7> product_digits(const std::array<Int, 3>& m, const std::array<Int, kWindow>& w) {
    std::array<Int, 7> digits;
    Int carry = integer(m[0], 0);
    for (size_t n = 7; n-- > 0;) {
        Int sum = m[0] * w[n] + m[1] * w[n + 1] + carry;
        if (n + 2 < kWindow) sum = sum + m[2] * w[n + 2];
        carry = shift_right_signed(sum + (1 << (kDigitBits - 1)), kDigitBits);
        digits[n] = n == 0 ? sum : sum - (carry << kDigitBits);
    }
    return digits;
}

// The digits after the point as hi + lo, to about 40 bits below the first that is not zero.
std::array<Num, 2> fraction(const std::array<Int, 7>& digits) {
    std::array<Num, 7> d;
    for (size_t i = 1; i < 7; ++i) d[i] = to_float(digits[i]) * std::ldexp(1.0f, int(i) * -14);
    Num top = d[1] + d[2];
    Num top_error = (d[1] - top) + d[2];
    Num next = top_error + d[3];
    Num low = next + d[4];
    Num low_error = ((next - low) + d[4]) + d[5];
    Num hi = top + low;
    return {hi, ((top - hi) + low) + low_error};
}

}  // namespace

Reduced reduce_huge(Num x) {
    Mask ordered = x == x;
    Int pattern = bits(abs(select(ordered, x, 0.0f)));  // no NaN's bits reach the integers
    Int m = (pattern & 0x7fffff) ^ 0x800000;
    Int e14 = shift_right(pattern, 23) - (127 + 23 - kDigitBits);  // e + 14
    Int q = shift_right(e14 * 4682, 16);                           // e14 / 14 for e14 < 3000
    std::array<Int, 7> digits =
        product_digits(shifted_mantissa(m, e14 - q * kDigitBits), digit_window(q));
    auto [hi, lo] = fraction(digits);
    // times pi/2
    Num r = hi * kHalfPi[0];
    Num r_low = fma(hi, kHalfPi[0], -r) + fma(hi, kHalfPi[1], lo * kHalfPi[0]);
    Int sign = sign_bit(select(ordered, x, 0.0f));
    Mask negative = sign < 0;
    Num finite = select(abs(x) < std::numeric_limits<float>::infinity(), r, x - x);
    return {flip_sign(finite, sign), flip_sign(r_low, sign),
            select(negative, integer(q, 0) - digits[0], digits[0])};
}

}  // namespace kinora::jit::math
