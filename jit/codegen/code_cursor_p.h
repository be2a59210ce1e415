// jit/codegen/code_cursor_p.h: the instruction in work, and where the values it reads lie.
#pragma once

#include <span>

#include "jit/codegen/function_code_p.h"

namespace kinora::jit {

// Walks over a function's instructions while their code is written. A value lies in its register or
// in memory, by the position alone, except while a loop's variables get their next values: then old
// values that are still read may lie in two rows of the frame.
class CodeCursor {
  public:
    explicit CodeCursor(const FunctionCode& code) : code_(code) {}

    const FunctionCode& code() const { return code_; }
    Value at() const { return at_; }  // also names the value that the instruction gives
    const Inst& operator*() const { return code_.inst(at_); }
    const Inst* operator->() const { return &code_.inst(at_); }
    std::span<const Value> args() const { return code_.function.args_of(**this); }

    const Inst& inst(Value v) const { return code_.inst(v); }
    Value root(Value v) const { return code_.root(v); }
    const LiveInterval& interval(Value v) const { return code_.interval(v); }
    const ValuePlan& plan(Value v) const { return code_.plan.values[v]; }
    bool in_register(Value v) const {
        v = root(v);
        return interval(v).in_reg(at_) && v != old_[0] && v != old_[1];
    }
    // The swap row that holds the old value of this variable, or -1.
    int old_row(Value v) const { return old_[0] == v ? 0 : old_[1] == v ? 1 : -1; }

    void start() { at_ = 0; }
    void advance() { ++at_; }
    bool is_done() const { return at_ >= code_.function.insts.size(); }
    // The old value of a variable was put into this swap row, and is read there until drop_old().
    void keep_old(int row, Value variable) { old_[row] = variable; }
    void drop_old() { old_[0] = old_[1] = kNone; }

  private:
    const FunctionCode& code_;
    Value at_ = 0;
    Value old_[2] = {kNone, kNone};  // by swap row
};

}  // namespace kinora::jit
