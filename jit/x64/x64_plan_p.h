// jit/x64/x64_plan_p.h: what the emitter decides about a function before it writes code.
#pragma once

#include <cstdint>
#include <vector>

#include "jit/regalloc.h"

namespace kinora::jit::x64 {

// An instruction set. Everything that differs between the two hangs on `wide`: AVX-512 has mask
// registers, embedded broadcasts and 32 registers.
struct Isa {
    const char* name;
    int lanes;
    bool wide;
    int vector_registers;  // the two after these are scratch
    int mask_registers;    // k1..k(n-1); k0 and k7 are scratch
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
    bool calls = false;  // has a Call or Service: no register lives through
};

FunctionPlan plan_function(const Module& module, const Function& function,
                           const Structure& structure, const Isa& isa);

AllocationLimits limits(const Isa& isa, const FunctionPlan& plan, bool is_kernel);

}  // namespace kinora::jit::x64
