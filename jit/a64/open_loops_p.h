// jit/a64/open_loops_p.h: the loops around the instruction in work, and what counts their rounds.
#pragma once

#include <vector>

#include "jit/a64/branches_p.h"
#include "jit/a64/operands_p.h"

namespace kinora::jit::a64 {

struct OpenLoop {
    Label header, exit;
    Gp counter;  // invalid: in memory
};

class OpenLoops {
  public:
    OpenLoops(arm::Assembler& a, const FunctionCode& code, Operands& operands, Branches& branches)
        : a_(a), code_(code), operands_(operands), branches_(branches) {}

    void open();
    void close() { loops_.pop_back(); }
    const OpenLoop& innermost() const { return loops_.back(); }

    // Of the innermost loop: its budget, and a branch to its header while that lasts.
    void set_counter();
    void count_down();

  private:
    arm::Mem counter_slot();

    arm::Assembler& a_;
    const FunctionCode& code_;
    Operands& operands_;
    Branches& branches_;
    std::vector<OpenLoop> loops_;
};

}  // namespace kinora::jit::a64
