// jit/passes/derivative_plan_p.h: which values need a derivative, before any is written.
#pragma once

#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Bits of a set of directions.
enum Directions : uint8_t { kAlongU = 1, kAlongV = 2 };

struct DerivativePlan {
    std::vector<uint8_t> values;  // per value: directions in which a derivative is to be written
    std::vector<uint8_t> arrays;  // per array of the function
};

// What a function's derivatives are asked for. `params` directions: its float parameters come with
// derivatives and its float results must give them; 0 for the kernel.
// A value is planned where it is both needed (a Du, Dv or result looks at it) and able to be other
// than zero (it follows from an input that has partials, or from a parameter).
// `asks[f]`: function f holds a Du or Dv itself, so that its arguments need derivatives.
DerivativePlan plan_derivatives(const Module& module, const Function& function, uint8_t params,
                                const std::vector<bool>& asks);

}  // namespace kinora::jit
