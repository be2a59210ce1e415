// jit/a64/records.cpp: records of a grid (light answers): sets[a].records[b].
#include "jit/a64/records_p.h"

#include <cstddef>

namespace kinora::jit::a64 {

using asmjit::arm::CondCode;
using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

static_assert(sizeof(RecordSet) == 16 && sizeof(Record) == 16);

// x1 = the record set of the instruction.
void Records::find_set() {
    const Inst& number = cursor_.inst(cursor_->a);
    bool known = number.op == Op::ConstI;
    if (!known) indices_.lane_to(arm::w0, cursor_->a);
    a_.ldr(arm::x1, arm::ptr(kArgs, offsetof(KernelArgs, record_sets)));
    if (!known)
        a_.add(arm::x1, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
    else if (number.imm != 0)
        operands_.add_offset(arm::x1, arm::x1, int64_t{number.imm} * int64_t{sizeof(RecordSet)});
}

void Records::op_RecordCount() {
    find_set();
    a_.ldr(arm::w0, arm::ptr(arm::x1, offsetof(RecordSet, count)));
    a_.dup(operands_.target().s4(), arm::w0);
    operands_.finish(operands_.target());
}

// kRecord = the record, or null if the set is empty and that is not ruled out.
void Records::find() {
    HeldRecord::Key key{cursor_.root(cursor_->a), cursor_.root(cursor_->b)};
    if (held_.is(key)) return;
    held_.hold(key);
    bool in_range = cursor_.code().plan.in_range[cursor_.at()];
    find_set();
    indices_.lane_to(arm::w0, cursor_->b);
    a_.ldr(kRecord, arm::ptr(arm::x1, offsetof(RecordSet, records)));
    if (!in_range) {
        // The index is held in 0..count-1.
        a_.ldr(arm::w2, arm::ptr(arm::x1, offsetof(RecordSet, count)));
        a_.cmp(arm::w0, 0);
        a_.csel(arm::w0, arm::wzr, arm::w0, CondCode::kLT);
        a_.sub(arm::w3, arm::w2, 1);
        a_.cmp(arm::w0, arm::w3);
        a_.csel(arm::w0, arm::w3, arm::w0, CondCode::kGT);
    }
    a_.add(kRecord, kRecord, arm::x0, Shift(ShiftOp::kLSL, 4));
    if (in_range) return;
    a_.cmp(arm::w2, 0);
    a_.csel(kRecord, arm::xzr, kRecord, CondCode::kLE);
}

void Records::read(bool uniform) {
    find();
    Vec to = operands_.target();
    Label none = a_.newLabel();
    if (!cursor_.code().plan.in_range[cursor_.at()]) {
        operands_.zero(to);
        a_.cbz(kRecord, none);
    }
    if (uniform) {
        a_.ldr(arm::x2, arm::ptr(kRecord, offsetof(Record, uniforms)));
        operands_.broadcast(to, operands_.address(arm::x2, int64_t{4} * cursor_->imm, 4));
    } else {
        a_.ldr(arm::x2, arm::ptr(kRecord, offsetof(Record, columns)));
        a_.ldr(arm::x2, operands_.address(arm::x2, int64_t{8} * cursor_->imm, 8));
        a_.ldr(to, arm::ptr(arm::x2, kGroup));
    }
    a_.bind(none);
    operands_.finish(to);
}

void Records::op_RecordField() {
    read(false);
}
void Records::op_RecordUniform() {
    read(true);
}

}  // namespace kinora::jit::a64
