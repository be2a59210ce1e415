// tests/raytrace/random/sequence_by_definition.h: the scrambled (0,2)-sequence bit by bit, for tests
// of kernels that draw from it (docs/decisions.md#random-numbers-without-state).
#pragma once

#include <cstdint>

namespace kinora {

inline uint32_t mix(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
inline uint32_t mix(uint32_t a, uint32_t b) {
    return mix(a ^ (mix(b) + 0x9e3779b9u));
}
inline uint32_t turned_round(uint32_t x) {
    uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1) << (31 - bit);
    return result;
}
// Of a number whose bits are in their own order.
inline uint32_t owen(uint32_t x, uint32_t seed) {
    x = turned_round(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return turned_round(x);
}
// Column k of the second generator matrix is row k of Pascal's triangle modulo 2.
inline uint32_t sobol(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 1u << 31; index; index >>= 1, column ^= column >> 1)
        if (index & 1) result ^= column;
    return result;
}

}  // namespace kinora
