// jit/x64/x64_isa_p.h: the two instruction sets.
#pragma once

#include "jit/code_plan_p.h"

namespace kinora::jit::x64 {

// Everything that differs between the two hangs on `wide`: AVX-512 has mask registers, embedded
// broadcasts and 32 registers.
struct Isa {
    const char* name;
    int lanes;
    bool wide;
    int vector_registers;  // the two after these are scratch
    int mask_registers;    // k1..k(n-1); k0 and k7 are scratch

    PlanRules rules() const { return {wide, true, true}; }
    AllocationLimits limits(const FunctionPlan& plan, bool is_kernel) const {
        AllocationLimits limits;
        limits.registers[0] = vector_registers;
        limits.registers[1] = mask_registers;
        limits.first[1] = wide ? 1 : 0;
        limits.hoist_function = is_kernel && !plan.calls;
        return limits;
    }
};

}  // namespace kinora::jit::x64
