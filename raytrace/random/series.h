// raytrace/random/series.h: parts of stratified sequences.
//
// B. Burley, Practical Hash-based Owen Scrambling, 2020: sequences that are drawn from side by side
// have their numbers shuffled, or a subset of one would be a pattern of the others.
#pragma once

#include <cstdint>

#include "raytrace/random/bits.h"

namespace kinora::raytrace {

// Samples part * n to (part + 1) * n - 1 of the sequence that `seed` chooses, for who draws n.
// Those who share a sequence and have a part each draw what is stratified together.
struct SampleSeries {
    uint32_t seed = 0, part = 0;
    bool shared = false;
};

// The series of one of those who draw at a place. Parts of a shared one come in an order of its own
// that keeps every first 2^k of them together.
inline SampleSeries series_of(const SampleSeries& place, uint32_t who) {
    constexpr uint32_t kMostParts = 1u << 20;
    const uint32_t seed = hash(place.seed, who);
    if (!place.shared) return {seed, 0, false};
    const uint32_t shuffled = owen_scramble_reversed(reverse_bits(place.part), hash(seed));
    return {seed, shuffled % kMostParts, true};
}

}  // namespace kinora::raytrace
