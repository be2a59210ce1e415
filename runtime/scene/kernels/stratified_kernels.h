// runtime/scene/kernels/stratified_kernels.h: numbers of sequences, sixteen at a time. All
// instruction sets give the same bits.
#pragma once

#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr int kSampleLanes = 16;

// Of sixteen points: raytrace::SampleSeries in columns.
struct alignas(64) SamplePlaces {
    uint32_t seed[kSampleLanes], part[kSampleLanes], shared[kSampleLanes];
};

struct StratifiedKernels {
    const char* name;
    // Rows of sixteen integers, bit for bit in floats: the number of a sequence, an index in it,
    // and how many numbers each point draws. `to`: two rows of numbers in [0, 1).
    void (*draw)(const SamplePlaces& places, const float* sequence, const float* index,
                 const float* count, float* to);
};
KINORA_KERNEL_TABLES(StratifiedKernels, Stratified);

// Those this CPU can run, and the widest of them.
const UsableKernels<StratifiedKernels>& usable_stratified_kernels();
const StratifiedKernels& stratified_kernels();

}  // namespace kinora
