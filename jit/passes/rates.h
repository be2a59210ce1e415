// jit/passes/rates.h: how often each value of a kernel changes: constant, per frame, per point.
#pragma once

#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

struct Rates {
    std::vector<Rate> rate;
    // A value that stands inside a loop or follows from one of its variables has no single value
    // per frame, so it cannot be a frame block slot, whatever its rate.
    std::vector<bool> in_loop;
};

// Rates of the kernel's values: a value takes the highest of its operands, of the masks that choose
// it and, for a loop's variables, of the masks that end the loop.
Rates infer_rates(const Module& module);

}  // namespace kinora::jit
