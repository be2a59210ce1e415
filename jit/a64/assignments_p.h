// jit/a64/assignments_p.h: values written at more than one point: Merges, loop variables, a loop's
// mask.
#pragma once

#include "jit/a64/blends_p.h"
#include "jit/a64/masks_p.h"

namespace kinora::jit::a64 {

// What jit::Joins writes with. Such a value with both a register and a slot fills the slot when its
// last write is done.
class Assignments {
  public:
    Assignments(arm::Assembler& a, CodeCursor& cursor, Operands& operands, Masks& masks,
                Blends& blends)
        : a_(a), cursor_(cursor), operands_(operands), masks_(masks), blends_(blends) {}

    void copy(Value to, Value from);
    void merge(Value to, Value from, Value mask);
    void keep_old(int row, Value variable);
    void drop_old() { cursor_.drop_old(); }
    void fill_slot(Value v);

    // These leave kAny: not zero if a lane runs the loop.
    void enter_loop(Value loop);
    void update_loop_mask(Value loop, Value next_mask);

  private:
    arm::Assembler& a_;
    CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Blends& blends_;
};

}  // namespace kinora::jit::a64
