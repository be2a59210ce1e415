// jit/x64/isa_p.h: the two instruction sets.
#pragma once

#include "jit/codegen/function_code_p.h"

namespace kinora::jit::x64 {

// Everything that differs between the two hangs on `wide`: AVX-512 has mask registers, embedded
// broadcasts and 32 registers.
struct Isa {
    const char* name;
    int lanes;
    bool wide;
    int vector_registers;  // the two after these are scratch
    int mask_registers;    // k1..k(n-1); k0 and k7 are scratch

    CodeRules rules() const {
        return {.plan = {wide, true, true},
                .limits = {.registers = {vector_registers, mask_registers}, .first = {0, wide}},
                .lanes = lanes};
    }
};

}  // namespace kinora::jit::x64
