// collada/text/number_reading.cpp: decimal to binary, exact, for powers of ten from -27 to 22.
#include "collada/text/number_reading_p.h"

#include <array>

namespace kinora::collada {

namespace {

constexpr int kMostFives = 27;  // 5^27 is the last below 2^63

constexpr auto kPowersOfFive = [] {
    std::array<uint64_t, kMostFives + 1> powers{1};
    for (size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] * 5;
    return powers;
}();

// mantissa / 10^k by a division of integers: with both shifted to their top bit the quotient has 63
// or 64 bits, so that its lowest may say "and a rest" without touching the rounding to 53.
double divide(uint64_t mantissa, int k) {
    uint64_t divisor = kPowersOfFive[size_t(k)];
    int up = std::countl_zero(mantissa), divisor_up = std::countl_zero(divisor);
    divisor <<= divisor_up;
    auto dividend = static_cast<unsigned __int128>(mantissa << up) << 63;
    uint64_t quotient = uint64_t(dividend / divisor);
    bool rest = uint64_t(dividend) != quotient * divisor;  // equal mod 2^64: equal, rest < divisor
    int exponent = divisor_up - up - 63 - k;
    return double(quotient | uint64_t(rest)) *
           std::bit_cast<double>(uint64_t(1023 + exponent) << 52);
}

}  // namespace

bool scale_long_decimal(uint64_t mantissa, int exponent, double& value) {
    if (mantissa == 0) {
        value = 0;
        return true;
    }
    if (exponent > 0 || exponent < -kMostFives) return false;
    value = divide(mantissa, -exponent);
    return true;
}

}  // namespace kinora::collada
