// jit/x64/assignments_p.h: values written at more than one point: Merges, loop variables, a loop's
// mask.
#pragma once

#include "jit/x64/blends_p.h"
#include "jit/x64/masks_p.h"

namespace kinora::jit::x64 {

// What jit::Joins writes with. Such a value with both a register and a slot fills the slot when its
// last write is done.
class Assignments {
  public:
    Assignments(x86::Assembler& a, const Isa& isa, CodeCursor& cursor, Operands& operands,
                Masks& masks, Blends& blends)
        : a_(a), isa_(isa), cursor_(cursor), operands_(operands), masks_(masks), blends_(blends) {}

    void copy(Value to, Value from);
    void merge(Value to, Value from, Value mask);
    void keep_old(int row, Value variable);
    void drop_old() { cursor_.drop_old(); }
    void fill_slot(Value v);

    // These leave flags: not zero if a lane runs the loop.
    void enter_loop(Value loop);
    void update_loop_mask(Value loop, Value next_mask);

  private:
    void merge_vector(Value to, Value from, Value mask);

    x86::Assembler& a_;
    const Isa& isa_;
    CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
    Blends& blends_;
};

}  // namespace kinora::jit::x64
