// jit/codegen/function_code_p.h: what every code generator knows of the function that it writes:
// the plan, the registers, the frame in scratch, and the instruction in work.
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
    int32_t service_args = 0, service_results = 0;
    std::vector<int32_t> arrays;
    int32_t bytes = 0;
};

// A step of giving a loop's variables their next values.
struct LoopUpdate {
    Value variable;
    Value next;        // kNone: keep the variable's old value in a swap row instead
    int swap_row = 0;  // 0 or 1
};

class FunctionCode {
  public:
    FunctionCode(const Module& module, size_t function_index, const CodeRules& rules);

    // Frame size is known before code is written, which is done for frames that fit alone.
    size_t frame_bytes() const { return frame_bytes_; }
    bool fits() const { return frame_bytes_ <= kMostFrameBytes; }
    // Something asks which lanes of a group hold points.
    bool uses_valid_lanes() const;
    // For tests: "" if the register allocation is proven right.
    std::string check() const {
        return check_allocation(f_, structure_, plan_.values, allocation_);
    }

  protected:
    const Inst& inst(Value v) const { return f_.insts[v]; }
    const Inst& now() const { return f_.insts[at_]; }
    Value root(Value v) const { return inst(v).op == Op::LoopOut ? inst(v).a : v; }
    const Place& place(Value v) const { return allocation_.places[v]; }
    bool is_zero(Value v) const;
    bool in_register(Value v) const {
        v = root(v);
        return place(v).in_reg(at_) && v != saved_[0] && v != saved_[1];
    }
    // Of the array that the instruction in work reads or writes.
    int32_t array_length() const { return f_.arrays[static_cast<size_t>(now().imm)].length; }
    int32_t array_offset() const { return layout_.arrays[static_cast<size_t>(now().imm)]; }
    // What the EndLoop in work does to the variables of `loop`. All change at once, and the mask
    // with them: a variable is written when no other still reads it, and a cycle is broken by
    // keeping one old value in memory.
    std::vector<LoopUpdate> loop_updates(Value loop) const;

    const Module& module_;
    const Function& f_;
    const bool is_kernel_;
    const size_t index_;
    Structure structure_;
    FunctionPlan plan_;
    Allocation allocation_;
    FrameLayout layout_;
    size_t frame_bytes_ = 0;
    Value at_ = 0;                     // the instruction in work
    Value saved_[2] = {kNone, kNone};  // variables whose old value lies in the swap rows

  private:
    void lay_out(int lanes);
};

}  // namespace kinora::jit
