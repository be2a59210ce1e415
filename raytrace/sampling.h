// raytrace/sampling.h: random numbers without state: a hash of who asks
// (docs/decisions.md#random-numbers-without-state).
#pragma once

#include <cstdint>

#include "runtime/base/math.h"

namespace kinora::raytrace {

// A well-mixed 32-bit hash (two multiply-xorshift rounds; constants by C. Wellons, "lowbias32").
constexpr uint32_t hash(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
constexpr uint32_t hash(uint32_t a, uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9u));
}
constexpr uint32_t hash(uint32_t a, uint32_t b, uint32_t c) {
    return hash(hash(a, b), c);
}

constexpr double unit_interval(uint32_t bits) {
    return double(bits) * 0x1p-32;
}  // [0, 1)

// Sample `index` of a pixel, both coordinates in [0,1): Owen-scrambled (0,2)-sequence, so that any
// first 2^k samples are stratified; `seed` decorrelates pixels and frames.
dvec2 stratified_sample(uint32_t index, uint32_t seed);

}  // namespace kinora::raytrace
