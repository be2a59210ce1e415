// jit/x64/records.cpp: records of a grid (light answers): sets[a].records[b].
#include "jit/x64/records_p.h"

#include <cstddef>

namespace kinora::jit::x64 {

static_assert(sizeof(RecordSet) == 16 && sizeof(Record) == 16);

// The record set, by rdx.
x86::Mem Records::find_set(Value set) {
    operands_.restart_pointers(0);
    const Inst& number = cursor_.inst(set);
    bool known = number.op == Op::ConstI;
    if (!known) indices_.lane_to(x86::eax, set);
    a_.mov(x86::rdx, x86::ptr(x86::rbx, offsetof(KernelArgs, record_sets)));
    if (!known) {
        a_.shl(x86::rax, 4);
        a_.add(x86::rdx, x86::rax);
    }
    operands_.restart_pointers(0);
    return x86::ptr(x86::rdx, known ? number.imm * static_cast<int32_t>(sizeof(RecordSet)) : 0);
}

void Records::op_RecordCount() {
    x86::Mem set = find_set(cursor_->a);
    x86::Vec to = operands_.target();
    a_.emit(Id::kIdVpbroadcastd, to, set.cloneAdjusted(offsetof(RecordSet, count)));
    operands_.finish(to);
}

void Records::find(Value set_value, Value index, bool in_range) {
    HeldRecord::Key key{cursor_.root(set_value), cursor_.root(index)};
    if (held_.is(key)) return;
    held_.hold(key);
    x86::Mem set = find_set(set_value);
    indices_.lane_to(x86::eax, index);
    if (!in_range) return find_clamped(set);
    a_.shl(x86::rax, 4);
    a_.mov(x86::rdi, set.cloneAdjusted(offsetof(RecordSet, records)));
    a_.mov(x86::r10, x86::ptr(x86::rdi, x86::rax, 0, offsetof(Record, columns)));
    a_.mov(x86::r11, x86::ptr(x86::rdi, x86::rax, 0, offsetof(Record, uniforms)));
}

// The index in eax is held in 0..count-1.
void Records::find_clamped(const x86::Mem& set) {
    a_.xor_(x86::ecx, x86::ecx);
    a_.test(x86::eax, x86::eax);
    a_.cmovs(x86::eax, x86::ecx);
    a_.mov(x86::ecx, set.cloneAdjusted(offsetof(RecordSet, count)));
    a_.lea(x86::esi, x86::ptr(x86::rcx, -1));
    a_.cmp(x86::eax, x86::esi);
    a_.cmovg(x86::eax, x86::esi);
    a_.shl(x86::rax, 4);
    a_.mov(x86::rdi, set.cloneAdjusted(offsetof(RecordSet, records)));
    a_.add(x86::rdi, x86::rax);
    a_.xor_(x86::r10d, x86::r10d);
    a_.xor_(x86::r11d, x86::r11d);
    a_.test(x86::ecx, x86::ecx);
    Label none = a_.newLabel();
    a_.jle(none);
    a_.mov(x86::r10, x86::ptr(x86::rdi, offsetof(Record, columns)));
    a_.mov(x86::r11, x86::ptr(x86::rdi, offsetof(Record, uniforms)));
    a_.bind(none);
}

void Records::read(bool uniform) {
    bool in_range = cursor_.code().plan.in_range[cursor_.at()];
    find(cursor_->a, cursor_->b, in_range);
    x86::Vec to = rows_.target();
    Label none = a_.newLabel();
    if (!in_range) {
        a_.vxorps(Operands::xmm(to), Operands::xmm(to), Operands::xmm(to));
        a_.test(x86::r10, x86::r10);
        a_.jz(none);
    }
    if (uniform) {
        a_.emit(Id::kIdVbroadcastss, to, x86::ptr(x86::r11, 4 * cursor_->imm));
    } else {
        a_.mov(x86::rcx, x86::ptr(x86::r10, 8 * cursor_->imm));
        a_.emit(Id::kIdVmovups, to, x86::ptr(x86::rcx, x86::rbp));
    }
    a_.bind(none);
    rows_.finish(to);
}

void Records::op_RecordField() {
    read(false);
}
void Records::op_RecordUniform() {
    read(true);
}

}  // namespace kinora::jit::x64
