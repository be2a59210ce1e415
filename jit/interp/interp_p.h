// jit/interp/interp_p.h: the machine that the interpreter's op functions work on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jit/ir/ir.h"
#include "jit/ir/kernel.h"

namespace kinora::jit::interp {

inline constexpr int kLanes = kMaxLanes;

// One value of sixteen lanes, whatever its type; a mask lane is all ones or zero.
struct alignas(64) Row {
    int32_t lane[kLanes];
};

// A function made ready to walk.
struct Code {
    const Function* function = nullptr;
    std::vector<Value> match;       // If, Loop -> their end; EndLoop -> its Loop
    std::vector<size_t> array_row;  // first row of each array
    size_t swap_row = 0;            // room for one loop's next values
    size_t rows = 0;                // of one activation: values, arrays, swap rows
};

struct Program {
    Module module;
    std::vector<Code> codes;
    size_t scratch_rows = 0;  // deepest chain of activations
};

// One activation of a function for the group of points from `first` on.
struct Frame {
    const Program& program;
    const KernelArgs& args;
    const Code& code;
    Row* rows;
    Row* free_rows;  // activations of callees start here
    int32_t first;
    uint32_t valid;  // lanes that hold points
    const Row* params;
    Row* results;

    Row& row(Value v) const { return rows[v]; }
};

// Executes instruction `at` and returns the next.
using Step = Value (*)(const Frame& frame, const Inst& inst, Value at);
using StepTable = std::array<Step, static_cast<size_t>(Op::Count)>;
const StepTable& steps();

// Walks the function to its Return.
void run_function(const Frame& frame);

uint32_t mask_bits(const Row& mask);

}  // namespace kinora::jit::interp
