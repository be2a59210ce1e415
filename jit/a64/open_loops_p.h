// jit/a64/open_loops_p.h: the loops around the instruction in work, and what counts their rounds.
#pragma once

#include <vector>

#include "jit/a64/branches_p.h"
#include "jit/a64/operands_p.h"

namespace kinora::jit::a64 {

struct OpenLoop {
    Value begin;
    Label header, exit;
    Gp counter;  // invalid: in memory
};

class OpenLoops {
  public:
    OpenLoops(arm::Assembler& a, const FunctionCode& code, Operands& operands, Branches& branches)
        : a_(a), code_(code), operands_(operands), branches_(branches) {}

    void open(Value begin);
    void close() { loops_.pop_back(); }
    const OpenLoop& innermost() const { return loops_.back(); }

    // Of the innermost loop: the first slice of its budget, and a branch to its header while that
    // lasts.
    void set_counter();
    void count_down();
    // Goes on with the next slice, or to the loop's exit if the kernel shall stop. Code behind is
    // reached after the last slice.
    void begin_next_slice();

  private:
    arm::Mem slot(int32_t first);  // by depth
    arm::Mem counter_slot() { return slot(code_.layout.counters); }
    arm::Mem slices_left() { return slot(code_.layout.slices_left); }
    void write_counter(int32_t rounds);

    arm::Assembler& a_;
    const FunctionCode& code_;
    Operands& operands_;
    Branches& branches_;
    std::vector<OpenLoop> loops_;
};

}  // namespace kinora::jit::a64
