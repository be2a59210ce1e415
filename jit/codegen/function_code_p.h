// jit/codegen/function_code_p.h: what is decided about a function before its code is written, for
// any target: the plan, the registers, and the frame in scratch.
#pragma once

#include <string>
#include <vector>

#include "jit/codegen/code_plan_p.h"
#include "jit/codegen/regalloc.h"
#include "jit/ir/kernel.h"

namespace kinora::jit {

inline constexpr int kRow = 4 * kMaxLanes;  // bytes of a row of lanes in memory shared with C++

// What of an instruction set the plan, the registers and the frame depend on.
struct CodeRules {
    PlanRules plan;
    AllocationLimits limits;  // whether the function may hoist is found here
    int lanes;
};

// The largest frame that code can reach into: offsets in it, and in those behind it, are int32.
inline constexpr size_t kMostFrameBytes = size_t{1} << 30;

// Where things lie in a function's frame, in bytes; of no use if it takes more than
// kMostFrameBytes.
struct FrameLayout {
    int32_t params = 0, results = 0;   // rows
    int32_t vectors = 0, masks = 0;    // spill slots
    int32_t swap = 0;                  // two rows for old values of loop variables
    int32_t lanes_a = 0, lanes_b = 0;  // rows for per-lane work
    int32_t counters = 0;              // loop counters by depth
    int32_t slices_left = 0;           // of loops by depth, where any has slices
    int32_t service_args = 0, service_results = 0;
    std::vector<int32_t> arrays;
    // What is cleared where the function is entered, in whole rows.
    struct Range {
        int32_t begin, end;
    };
    std::vector<Range> cleared;
    int32_t bytes = 0;

    // Behind what was cleared before.
    void clear(int32_t at, size_t size);
};

// Nothing changes after construction. Frame size is known before code is written, which is done for
// frames that fit alone.
struct FunctionCode {
    FunctionCode(const Module& module, size_t function_index, const CodeRules& rules);

    bool fits() const { return frame_bytes <= kMostFrameBytes; }
    // Something asks which lanes of a group hold points.
    bool uses_valid_lanes() const;
    // For tests: "" if the register allocation is proven right.
    std::string check() const {
        return check_allocation(function, structure, plan.values, allocation);
    }

    const Inst& inst(Value v) const { return function.insts[v]; }
    // The LoopVar whose register and memory a LoopOut shares; other values are their own.
    Value root(Value v) const { return inst(v).op == Op::LoopOut ? inst(v).a : v; }
    const LiveInterval& interval(Value v) const { return allocation.intervals[v]; }
    bool is_zero(Value v) const;

    const Module& module;
    const Function& function;
    const size_t index;
    const bool is_kernel;
    const Structure structure;
    const FunctionPlan plan;
    const Allocation allocation;
    FrameLayout layout;
    size_t frame_bytes = 0;

  private:
    void lay_out(int lanes);
};

}  // namespace kinora::jit
