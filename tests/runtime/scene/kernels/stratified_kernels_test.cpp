// tests/runtime/scene/kernels/stratified_kernels_test.cpp: numbers of sequences sixteen at a time
// against their definition, one bit after the other; all instruction sets give the same bits.
#include "runtime/scene/kernels/stratified_kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <span>

namespace kinora {
namespace {

std::span<const StratifiedKernels* const> all_kernels() {
    const UsableKernels<StratifiedKernels>& usable = usable_stratified_kernels();
    return {usable.kernels, usable.count};
}

// ---- the sequence, by its definition ------------------------------------------------------------

uint32_t mix(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t mix(uint32_t a, uint32_t b) {
    return mix(a ^ (mix(b) + 0x9e3779b9u));
}
uint32_t turned_round(uint32_t x) {
    uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1) << (31 - bit);
    return result;
}
// Of a number whose bits are in their own order.
uint32_t owen(uint32_t x, uint32_t seed) {
    x = turned_round(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return turned_round(x);
}
// Column k of the second generator matrix is row k of Pascal's triangle modulo 2.
uint32_t sobol(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 1u << 31; index; index >>= 1, column ^= column >> 1)
        if (index & 1) result ^= column;
    return result;
}

struct Draw {
    uint32_t seed, part, shared, sequence, index, count;
};
// The first 24 bits of both dimensions.
uint32_t drawn(const Draw& from, int dimension) {
    const uint32_t seed = mix(from.seed, from.sequence);
    const uint32_t part = from.shared ? owen(from.part, mix(seed)) % (1u << 20) : 0;
    const uint32_t number = part * from.count + from.index;
    return dimension == 0 ? owen(turned_round(number), mix(seed, 0x68bc21ebu)) >> 8
                          : owen(sobol(number), mix(seed, 0x02e5be93u)) >> 8;
}

TEST(StratifiedKernels, FollowTheDefinitionOnAllInstructionSets) {
    std::mt19937 random(3);
    for (int turn = 0; turn < 500; ++turn) {
        Draw draws[kSampleLanes];
        SamplePlaces places;
        float sequence[kSampleLanes], index[kSampleLanes], count[kSampleLanes];
        for (int i = 0; i < kSampleLanes; ++i) {
            const Draw d{uint32_t(random()), uint32_t(random() % 5000), uint32_t(random() % 2),
                         uint32_t(random()), uint32_t(random() % 64),   uint32_t(random() % 64)};
            draws[i] = d;
            places.seed[i] = d.seed, places.part[i] = d.part, places.shared[i] = d.shared;
            sequence[i] = std::bit_cast<float>(d.sequence);
            index[i] = std::bit_cast<float>(d.index), count[i] = std::bit_cast<float>(d.count);
        }
        for (const StratifiedKernels* kernels : all_kernels()) {
            float numbers[2 * kSampleLanes];
            kernels->draw(places, sequence, index, count, numbers);
            for (int i = 0; i < kSampleLanes; ++i)
                for (int k = 0; k < 2; ++k)
                    ASSERT_EQ(double(numbers[k * kSampleLanes + i]), drawn(draws[i], k) * 0x1p-24)
                        << kernels->name << " lane " << i;
        }
    }
}

}  // namespace
}  // namespace kinora
