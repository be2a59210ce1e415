// runtime/picture/lights/kernels.h: what is asked of a light at many points; one source, compiled
// per instruction set and chosen at run time. All give the same bits.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

// Columns of `count` numbers; none of those written may overlap another that is read.
struct LightKernels {
    const char* name;
    // The least and the greatest; NaN does not count. Without any, infinity and -infinity.
    void (*bounds)(const float* column, size_t count, float& low, float& high);
    // The cell of each place among 8 x 8 x 8, such that cells of near numbers are near: along each
    // axis (P - low) * scale, held within 0 to 7; NaN is 0. A bit of each axis in turns.
    void (*cells)(const float* const P[3], const float low[3], const float scale[3], size_t count,
                  uint32_t* cell);
    // signs[i] *= 1 where V looks against I, -1 where along it, 0 where rounding may decide.
    void (*turn_signs)(const float* const V[3], const float* const I[3], size_t count,
                       float* signs);
    // Makes Cl 0 where L surely looks along N and `along` is 0, or against N and `against` is 0.
    void (*darken_unseen)(const float* const N[3], const float* const L[3], const float* along,
                          const float* against, size_t count, float* const Cl[3]);
    // The points where something is sent: `lit` is not 0 (null: everywhere), nor is all of Cl.
    // Their numbers, in order; how many.
    size_t (*choose)(const float* const Cl[3], const float* lit, size_t count, uint32_t* chosen);
    // limits[i] += share * strength of Cl: its largest component, 0 of what is no number.
    void (*add_strengths)(const float* const Cl[3], float share, size_t count, float* limits);
    // Sets weak[i] where the strength is in (0, limits[i]]; whether there is such a point.
    bool (*mark_weak)(const float* const Cl[3], const float* limits, size_t count, uint32_t* weak);
};
KINORA_KERNEL_TABLES(LightKernels, Lights);

// Those this CPU can run, and the widest of them.
const UsableKernels<LightKernels>& usable_light_kernels();
const LightKernels& light_kernels();

}  // namespace kinora
