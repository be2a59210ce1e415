// jit/codegen/joins_p.h: what is written where control flow joins: Merges and loop variables.
#pragma once

#include "jit/codegen/code_cursor_p.h"
#include "jit/codegen/loop_updates_p.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit {

// The same for every target. `Assignments` writes a target's code:
//   copy(to, from)        for all lanes
//   merge(to, from, mask) for the lanes of a mask
//   keep_old(row, v)      copies a variable to a swap row, where it is read from then on
//   drop_old()            ends that
//   fill_slot(v)          copies the register to the slot of a value that has both
template <class Assignments>
class Joins {
  public:
    Joins(const CodeCursor& cursor, Assignments& assignments)
        : cursor_(cursor), assignments_(assignments) {}

    // At an If: all lanes get the values of those that do not run it.
    void begin_merges() {
        Value end = cursor_.code().structure.end_of[cursor_.at()];
        for (Value m = end + 1; is_merge(m); ++m) assignments_.copy(m, cursor_.inst(m).b);
    }
    // At an EndIf, where lanes ran it: they get theirs.
    void end_merges() {
        auto begin = static_cast<Value>(cursor_->imm);
        bool masked = cursor_.plan(begin).masked && !planted(PlantedFault::MergeIgnoresMask);
        for (Value m = cursor_.at() + 1; is_merge(m); ++m) {
            Value arm = cursor_.inst(m).a;
            if (masked)
                assignments_.merge(m, arm, cursor_.inst(begin).a);
            else
                assignments_.copy(m, arm);
        }
    }
    // At an EndIf, where both ways have met.
    void fill_merges() {
        for (Value m = cursor_.at() + 1; is_merge(m); ++m) assignments_.fill_slot(m);
    }

    // At an EndLoop, where a lane ran its body: the variables get their next values. The loop's
    // mask, which `update_mask` writes, is the last.
    template <class UpdateMask>
    void update_variables(Value loop, UpdateMask&& update_mask) {
        for (const LoopUpdate& step : loop_updates(cursor_.code(), loop)) {
            if (step.next == kNone)
                assignments_.keep_old(step.swap_row, step.variable);
            else if (cursor_.plan(loop).masked)
                assignments_.merge(step.variable, step.next, loop);
            else
                assignments_.copy(step.variable, step.next);
        }
        update_mask();
        assignments_.drop_old();
    }
    // At an EndLoop, where the loop is left.
    void fill_variables(Value loop) {
        Value last = cursor_.code().structure.header_of[loop];
        for (Value v = loop + 1; v <= last; ++v) assignments_.fill_slot(v);
    }

  private:
    bool is_merge(Value v) const { return cursor_.inst(v).op == Op::Merge; }

    const CodeCursor& cursor_;
    Assignments& assignments_;
};

}  // namespace kinora::jit
