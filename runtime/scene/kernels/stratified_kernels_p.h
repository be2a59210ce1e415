// runtime/scene/kernels/stratified_kernels_p.h: the kernel, a loop over sixteen that the compiler
// makes vectors of. Included by one file for each instruction set; all names are the file's own.
#pragma once

#include "raytrace/random/series.h"
#include "runtime/scene/kernels/stratified_kernels.h"

namespace kinora {
namespace {

// The top 24 bits: never 1.
__attribute__((always_inline)) inline float below_one(uint32_t bits) {
    return float(int32_t(bits >> 8)) * 0x1p-24f;
}

// Flattened, since a copy of series_of() for this instruction set could be the one that the linker
// takes for all of the program.
__attribute__((flatten)) void draw(const SamplePlaces& places, const float* sequence,
                                   const float* index, const float* count, float* to) {
    uint32_t who[kSampleLanes], which[kSampleLanes], of[kSampleLanes];
    __builtin_memcpy(who, sequence, sizeof(who));
    __builtin_memcpy(which, index, sizeof(which));
    __builtin_memcpy(of, count, sizeof(of));
    _Pragma("GCC ivdep") for (int i = 0; i < kSampleLanes; ++i) {
        const raytrace::SampleSeries series =
            raytrace::series_of({places.seed[i], places.part[i], places.shared[i] != 0}, who[i]);
        const uint32_t number = series.part * of[i] + which[i];
        to[i] = below_one(
            raytrace::owen_scramble_reversed(number, raytrace::first_scramble(series.seed)));
        to[kSampleLanes + i] = below_one(raytrace::owen_scramble_reversed(
            raytrace::sobol_second_reversed(number), raytrace::second_scramble(series.seed)));
    }
}

}  // namespace

extern const StratifiedKernels KINORA_KERNEL_TABLE(Stratified);
const StratifiedKernels KINORA_KERNEL_TABLE(Stratified) = {KINORA_INSTRUCTION_SET, draw};

}  // namespace kinora
