// jit/x64/records.cpp: records of a grid (light answers): sets[a].records[b].
#include "jit/x64/emit_p.h"

namespace kinora::jit::x64 {

static_assert(sizeof(RecordSet) == 16 && sizeof(Record) == 16);

// One lane's int. If lanes need not agree the value is that of a lane that runs the loop we are in:
// those that have left it keep older indices.
void Emit::lane_to(const x86::Gp& to, Value index) {
    index = root(index);
    Value loop = structure_.loop_of[at_];
    if (inst(index).op == Op::ConstI) {
        a_.mov(to, inst(index).imm);
    } else if (!plan_.agree[index] && loop != kNone && plan_.values[loop].masked) {
        a_.emit(Id::kIdVmovaps, row(layout_.lanes_a), reg(index, 0));
        mask_bits(to, loop);
        a_.tzcnt(to, to);
        a_.mov(to, x86::ptr(x86::r15, to.r64(), 2, layout_.lanes_a));
    } else if (const OpenLoop* counting = counted_by(index)) {
        index_in(to, *counting, 0);
    } else if (in_register(index)) {
        a_.vmovd(to, xmm(vec(place(index).reg)));
    } else {
        x86::Mem word = home(index);
        word.resetBroadcast();
        word.setSize(4);
        a_.mov(to, word);
    }
}

// The open loop whose budget counts this value, or null.
const Emit::OpenLoop* Emit::counted_by(Value index) const {
    for (const OpenLoop& loop : loops_)
        if (plan_.counted[loop.begin] == index) return &loop;
    return nullptr;
}

// The record set, by rdx.
x86::Mem Emit::find_set(Value set) {
    gp_turn_ = 0;
    int32_t offset = 0;
    if (inst(set).op == Op::ConstI)
        offset = inst(set).imm * static_cast<int32_t>(sizeof(RecordSet));
    else
        lane_to(x86::eax, set);
    a_.mov(x86::rdx, x86::ptr(x86::rbx, offsetof(KernelArgs, record_sets)));
    if (inst(set).op != Op::ConstI) {
        a_.shl(x86::rax, 4);
        a_.add(x86::rdx, x86::rax);
    }
    gp_turn_ = 0;
    return x86::ptr(x86::rdx, offset);
}

void Emit::op_RecordCount() {
    x86::Mem set = find_set(now().a);
    x86::Vec to = target();
    a_.emit(Id::kIdVpbroadcastd, to, set.cloneAdjusted(offsetof(RecordSet, count)));
    finish(to);
}

// r10, r11 = the columns and uniforms of the record, both null if the set is empty and that is not
// ruled out. They are kept from read to read until control flow joins or another record is read.
void Emit::find_record(Value set_value, Value index, bool in_range) {
    if (record_ == root(index) && record_set_ == root(set_value)) return;
    record_ = root(index);
    record_set_ = root(set_value);
    x86::Mem set = find_set(set_value);
    lane_to(x86::eax, index);
    if (in_range) {
        a_.shl(x86::rax, 4);
        a_.mov(x86::rdi, set.cloneAdjusted(offsetof(RecordSet, records)));
        a_.mov(x86::r10, x86::ptr(x86::rdi, x86::rax, 0, offsetof(Record, columns)));
        a_.mov(x86::r11, x86::ptr(x86::rdi, x86::rax, 0, offsetof(Record, uniforms)));
        return;
    }
    // The index is held in 0..count-1.
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

void Emit::read_record(bool uniform) {
    find_record(now().a, now().b, plan_.in_range[at_]);
    x86::Vec to = is_mask(at_) ? scratch(0) : target();
    Label none = a_.newLabel();
    if (!plan_.in_range[at_]) {
        a_.vxorps(xmm(to), xmm(to), xmm(to));
        a_.test(x86::r10, x86::r10);
        a_.jz(none);
    }
    if (uniform) {
        a_.emit(Id::kIdVbroadcastss, to, x86::ptr(x86::r11, 4 * now().imm));
    } else {
        a_.mov(x86::rcx, x86::ptr(x86::r10, 8 * now().imm));
        a_.emit(Id::kIdVmovups, to, x86::ptr(x86::rcx, x86::rbp));
    }
    a_.bind(none);
    finish_typed(to);
}

void Emit::op_RecordField() {
    read_record(false);
}
void Emit::op_RecordUniform() {
    read_record(true);
}

}  // namespace kinora::jit::x64
