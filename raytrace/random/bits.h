// raytrace/random/bits.h: the hashes and the scrambled sequence behind all random numbers, bit by
// bit (docs/decisions.md#random-numbers-without-state).
//
// Kernel files, compiled for one instruction set each, include this: every function is always
// inlined, so that the linker has no copy to choose from.
#pragma once

#include <cstdint>

namespace kinora::raytrace {

#define KINORA_BITS __attribute__((always_inline)) constexpr inline

// A well-mixed 32-bit hash (two multiply-xorshift rounds; constants by C. Wellons, "lowbias32").
KINORA_BITS uint32_t hash(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
KINORA_BITS uint32_t hash(uint32_t a, uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9u));
}
KINORA_BITS uint32_t hash(uint32_t a, uint32_t b, uint32_t c) {
    return hash(hash(a, b), c);
}

KINORA_BITS uint32_t reverse_bits(uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Nested uniform scrambling of a number whose bits are reversed: each bit is flipped by a hash of
// the bits above it. Laine, Karras: Stratified sampling for stochastic transparency, 2011;
// constants of N. Vegdahl, 2021.
KINORA_BITS uint32_t owen_scramble_reversed(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

// The second dimension of Sobol's sequence, bits reversed (the first, van der Corput's, is then the
// index): the Pascal matrix modulo 2 is a product of five sparse ones, each adding to bit b the bit
// b + 2^k where b lacks 2^k.
KINORA_BITS uint32_t sobol_second_reversed(uint32_t index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ ((index >> 16) & 0x0000ffffu);
}

// What scrambles the two dimensions of the sequence that `seed` chooses.
KINORA_BITS uint32_t first_scramble(uint32_t seed) {
    return hash(seed, 0x68bc21ebu);
}
KINORA_BITS uint32_t second_scramble(uint32_t seed) {
    return hash(seed, 0x02e5be93u);
}

#undef KINORA_BITS

}  // namespace kinora::raytrace
