// jit/codegen/loop_slices_p.h: after how many rounds a loop looks whether its kernel shall stop.
//
// Rounds are counted down anyway, for the budget. A long loop counts a slice of them at a time and
// looks at KernelArgs::stop between two slices, so that a round costs no more than before.
#pragma once

#include <cstdint>
#include <vector>

#include "jit/codegen/code_plan_p.h"

namespace kinora::jit {

// FunctionPlan::slices. Loops over records have none.
std::vector<int32_t> loop_slices(const Module& module, const Function& function,
                                 const Structure& structure, const FunctionPlan& plan);

// So many rounds: the first slice, and how many of `length` follow it.
struct Slices {
    int32_t first = 0, more = 0, length = 0;
};
inline Slices slices_of(int32_t rounds, int32_t length) {
    if (length == 0 || rounds < 1) return {rounds, 0, length};
    return {(rounds - 1) % length + 1, (rounds - 1) / length, length};
}

}  // namespace kinora::jit
