// jit/codegen/code_plan_p.h: what an emitter decides about a function before it writes code, for
// any target.
#pragma once

#include <cstdint>
#include <vector>

#include "jit/codegen/regalloc.h"

namespace kinora::jit {

// What of an instruction set matters here.
struct PlanRules {
    // Masks have registers of their own; compares and arms of Select can be computed under one.
    bool mask_registers;
    bool inverted_compares;  // of floats, true on NaN: they take a Not in
    bool counted_loops;      // the emitter knows FunctionPlan::counted and fused tests of records
};

struct FunctionPlan {
    std::vector<ValuePlan> values;
    std::vector<bool> agree;   // the value is the same in all lanes
    std::vector<bool> branch;  // of If: jump over the body when no lane runs it
    // Of record reads: the loop around holds the index in range and the set is not empty.
    std::vector<bool> in_range;
    // Of Loop: the variable that counts records and needs no vector register, or kNone. It is the
    // loop's budget at the start minus what is left of it, plus its first value.
    std::vector<Value> counted;
    // Of Loop: how often its body runs for the lanes that enter, where that is known; else 0. Such
    // a loop counts down in a general register and compares nothing.
    std::vector<int32_t> rounds;
    // Of Loop: rounds between two looks at KernelArgs::stop; 0: none, it ends soon by itself.
    std::vector<int32_t> slices;
    bool calls = false;  // has a Call or Service: no register lives through
};

FunctionPlan plan_function(const Module& module, const Function& function,
                           const Structure& structure, const PlanRules& rules);

}  // namespace kinora::jit
