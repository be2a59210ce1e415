// jit/a64/records.cpp: records of a grid (light answers): sets[a].records[b].
#include <cstddef>

#include "jit/a64/emit_p.h"

namespace kinora::jit::a64 {

using asmjit::arm::CondCode;
using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

static_assert(sizeof(RecordSet) == 16 && sizeof(Record) == 16);

// One lane's int. If lanes need not agree the value is that of a lane that runs the loop we are in:
// those that have left it keep older indices.
void Emit::lane_to(const Gp& to, Value index) {
    index = root(index);
    Value loop = structure_.loop_of[at_];
    if (inst(index).op == Op::ConstI) {
        a_.mov(to, static_cast<uint32_t>(inst(index).imm));
    } else if (!plan_.agree[index] && loop != kNone && plan_.values[loop].masked) {
        Vec lanes = reg(index, 0);
        a_.str(lanes, row(layout_.lanes_a));
        mask_bits(to, loop);
        a_.rbit(to, to);
        a_.clz(to, to);
        add_offset(arm::x16, kStack, layout_.lanes_a);
        a_.ldr(to, arm::ptr(arm::x16, to.x(), Shift(ShiftOp::kLSL, 2)));
    } else {
        a_.umov(to, reg(index, 1).s(0));
    }
}

// x1 = the record set of the instruction.
void Emit::find_set() {
    bool known = inst(now().a).op == Op::ConstI;
    if (!known) lane_to(arm::w0, now().a);
    a_.ldr(arm::x1, arm::ptr(kArgs, offsetof(KernelArgs, record_sets)));
    if (!known)
        a_.add(arm::x1, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
    else if (inst(now().a).imm != 0)
        add_offset(arm::x1, arm::x1, int64_t{inst(now().a).imm} * int64_t{sizeof(RecordSet)});
}

void Emit::op_RecordCount() {
    find_set();
    a_.ldr(arm::w0, arm::ptr(arm::x1, offsetof(RecordSet, count)));
    a_.dup(target().s4(), arm::w0);
    finish(target());
}

// kRecord = the record, or null if the set is empty and that is not ruled out. It is kept from read
// to read until control flow joins or another record is read.
void Emit::find_record() {
    if (record_ == root(now().b) && record_set_ == root(now().a)) return;
    record_ = root(now().b);
    record_set_ = root(now().a);
    find_set();
    lane_to(arm::w0, now().b);
    a_.ldr(kRecord, arm::ptr(arm::x1, offsetof(RecordSet, records)));
    if (!plan_.in_range[at_]) {
        // The index is held in 0..count-1.
        a_.ldr(arm::w2, arm::ptr(arm::x1, offsetof(RecordSet, count)));
        a_.cmp(arm::w0, 0);
        a_.csel(arm::w0, arm::wzr, arm::w0, CondCode::kLT);
        a_.sub(arm::w3, arm::w2, 1);
        a_.cmp(arm::w0, arm::w3);
        a_.csel(arm::w0, arm::w3, arm::w0, CondCode::kGT);
    }
    a_.add(kRecord, kRecord, arm::x0, Shift(ShiftOp::kLSL, 4));
    if (plan_.in_range[at_]) return;
    a_.cmp(arm::w2, 0);
    a_.csel(kRecord, arm::xzr, kRecord, CondCode::kLE);
}

void Emit::read_record(bool uniform) {
    find_record();
    Vec to = target();
    Label none = a_.newLabel();
    if (!plan_.in_range[at_]) {
        zero(to);
        a_.cbz(kRecord, none);
    }
    if (uniform) {
        a_.ldr(arm::x2, arm::ptr(kRecord, offsetof(Record, uniforms)));
        broadcast(to, at(arm::x2, int64_t{4} * now().imm, 4));
    } else {
        a_.ldr(arm::x2, arm::ptr(kRecord, offsetof(Record, columns)));
        a_.ldr(arm::x2, at(arm::x2, int64_t{8} * now().imm, 8));
        a_.ldr(to, arm::ptr(arm::x2, kGroup));
    }
    a_.bind(none);
    finish(to);
}

void Emit::op_RecordField() {
    read_record(false);
}
void Emit::op_RecordUniform() {
    read_record(true);
}

}  // namespace kinora::jit::a64
