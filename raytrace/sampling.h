// raytrace/sampling.h: random numbers without state: a hash of who asks
// (docs/decisions.md#random-numbers-without-state).
#pragma once

#include <cstdint>

#include "raytrace/random/bits.h"
#include "runtime/base/math.h"

namespace kinora::raytrace {

constexpr double unit_interval(uint32_t bits) {
    return double(bits) * 0x1p-32;
}  // [0, 1)

// Sample `index` of a pixel, both coordinates in [0,1): Owen-scrambled (0,2)-sequence, so that any
// first 2^k samples are stratified; `seed` decorrelates pixels and frames.
dvec2 stratified_sample(uint32_t index, uint32_t seed);

}  // namespace kinora::raytrace
