// tests/runtime/scene/kernels/stratified_kernels_test.cpp: numbers of sequences sixteen at a time
// against their definition, one bit after the other; all instruction sets give the same bits.
#include "runtime/scene/kernels/stratified_kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <span>

#include "tests/raytrace/random/sequence_by_definition.h"

namespace kinora {
namespace {

std::span<const StratifiedKernels* const> all_kernels() {
    const UsableKernels<StratifiedKernels>& usable = usable_stratified_kernels();
    return {usable.kernels, usable.count};
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
