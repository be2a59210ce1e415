// raytrace/sampling.cpp: the scrambled (0,2)-sequence behind pixel samples.
#include "raytrace/sampling.h"

namespace kinora::raytrace {

namespace {

uint32_t reverse_bits(uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Nested uniform scrambling: each bit is flipped by a hash of the bits above it. Laine, Karras:
// Stratified sampling for stochastic transparency, 2011; constants of N. Vegdahl, 2021.
uint32_t owen_scramble(uint32_t x, uint32_t seed) {
    x = reverse_bits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

// Second dimension of Sobol's sequence: columns of the Pascal matrix modulo 2.
uint32_t sobol_second(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1)
        if (index & 1) result ^= column;
    return result;
}

}  // namespace

dvec2 stratified_sample(uint32_t index, uint32_t seed) {
    uint32_t x = reverse_bits(index), y = sobol_second(index);
    return {unit_interval(owen_scramble(x, hash(seed, 0x68bc21ebu))),
            unit_interval(owen_scramble(y, hash(seed, 0x02e5be93u)))};
}

}  // namespace kinora::raytrace
