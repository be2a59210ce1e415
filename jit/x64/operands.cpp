// jit/x64/operands.cpp: from a value to the register or memory that holds it now.
#include "jit/x64/operands_p.h"

#include "jit/ir/planted_fault.h"
#include "runtime/base/check.h"

namespace kinora::jit::x64 {

x86::Vec Operands::vec(int index) const {
    auto id = static_cast<uint32_t>(index);
    return isa_.wide ? static_cast<x86::Vec>(x86::zmm(id)) : static_cast<x86::Vec>(x86::ymm(id));
}

x86::Gp Operands::next_pointer() {
    static constexpr x86::Gp kTurn[] = {x86::rax, x86::rcx, x86::rdx, x86::rsi};
    return kTurn[gp_turn_++ & 3];
}

x86::Mem Operands::constant(uint32_t bits) const {
    x86::Mem mem = pool_.word(bits);
    return isa_.wide ? mem._1to16() : mem;
}

x86::Mem Operands::slot(Value v) const {
    int32_t index = cursor_.interval(v).slot;
    CHECK_GE(index, 0);
    const FrameLayout& layout = cursor_.code().layout;
    if (is_mask(v)) return row(layout.masks + 8 * index);
    return row(layout.vectors + 4 * isa_.lanes * index);
}

x86::Mem Operands::memory(Value v) {
    const Inst& i = cursor_.inst(v);
    if (int k = cursor_.old_row(v); k >= 0) return swap_row(k);
    switch (i.op) {
        case Op::ConstF:
        case Op::ConstI:
            return constant(static_cast<uint32_t>(i.imm));
        case Op::ConstM:
            return constant(i.imm != 0 ? ~0u : 0u);
        case Op::Loop: {  // unmasked: all lanes run
            if (!cursor_.plan(v).masked) return constant(~0u);
            return slot(v);
        }
        case Op::FrameLoad: {
            bool stale = planted(PlantedFault::StaleFrameSlot) && i.imm > 0;
            if (isa_.wide) return x86::ptr(x86::r14, 4 * (i.imm - stale))._1to16();
            int32_t index = frame_row_[static_cast<size_t>(i.imm)];
            if (stale && index > 0) --index;
            return x86::ptr(x86::r13, kFrameRows + 32 * index);
        }
        case Op::Input: {
            x86::Gp pointer = next_pointer();
            a_.mov(pointer, x86::ptr(x86::r12, 8 * i.imm));
            return x86::ptr(pointer, x86::rbp);
        }
        case Op::Param:
            return row(cursor_.code().layout.params + kRow * i.imm);
        default:
            return slot(v);
    }
}

Operand Operands::operand(Value v) {
    v = cursor_.root(v);
    if (cursor_.in_register(v)) return vec(cursor_.interval(v).reg);
    return memory(v);
}

x86::Vec Operands::reg(Value v, int scratch_index) {
    v = cursor_.root(v);
    if (cursor_.in_register(v)) return vec(cursor_.interval(v).reg);
    x86::Vec to = scratch(scratch_index);
    load(to, v);
    return to;
}

bool Operands::lies_in(const x86::Vec& r, Value v) const {
    return cursor_.in_register(v) &&
           static_cast<uint32_t>(cursor_.interval(cursor_.root(v)).reg) == r.id();
}

void Operands::load_memory(const x86::Vec& to, const x86::Mem& from) {
    if (from.hasBroadcast()) {
        x86::Mem word = from;
        word.resetBroadcast();
        a_.emit(Id::kIdVbroadcastss, to, word);
    } else {
        a_.emit(Id::kIdVmovaps, to, from);
    }
}

void Operands::load_constant(Value v) {
    x86::Vec to = vec(cursor_.interval(v).reg);
    if (cursor_.code().is_zero(v))
        a_.vxorps(xmm(to), xmm(to), xmm(to));
    else
        load_memory(to, memory(v));
}

void Operands::load_input(Value v) {
    load_memory(vec(cursor_.interval(v).reg), memory(v));
}

void Operands::load(const x86::Vec& to, Value v) {
    v = cursor_.root(v);
    if (cursor_.in_register(v)) {
        x86::Vec from = vec(cursor_.interval(v).reg);
        if (from.id() != to.id()) a_.emit(Id::kIdVmovaps, to, from);
    } else if (cursor_.code().is_zero(v)) {
        a_.vxorps(xmm(to), xmm(to), xmm(to));
    } else {
        load_memory(to, memory(v));
    }
}

x86::Vec Operands::target() const {
    const LiveInterval& value = cursor_.interval(cursor_.at());
    return value.in_reg(value.begin) ? vec(value.reg) : scratch(0);
}

void Operands::store_slot(Value v, const x86::Vec& value) {
    const LiveInterval& interval = cursor_.interval(v);
    if (planted(PlantedFault::MissingSpill) && interval.reg >= 0) return;
    if (interval.slot >= 0) a_.emit(Id::kIdVmovaps, slot(v), value);
}

x86::KReg Operands::mask_target() const {
    const LiveInterval& value = cursor_.interval(cursor_.at());
    return value.in_reg(value.begin) ? k(value.reg) : x86::k7;
}

void Operands::load_mask(const x86::KReg& to, Value v) {
    v = cursor_.root(v);
    const Inst& i = cursor_.inst(v);
    if (cursor_.in_register(v)) {
        x86::KReg from = k(cursor_.interval(v).reg);
        if (from.id() != to.id()) a_.kmovw(to, from);
    } else if (i.op == Op::ConstM && i.imm == 0) {
        a_.kxorw(to, to, to);
    } else if (i.op == Op::ConstM || (i.op == Op::Loop && !cursor_.plan(v).masked)) {
        a_.kxnorw(to, to, to);
    } else {
        a_.kmovw(to, memory(v));
    }
}

x86::KReg Operands::mask_reg(Value v, int scratch_index) {
    v = cursor_.root(v);
    if (cursor_.in_register(v)) return k(cursor_.interval(v).reg);
    x86::KReg to = k(scratch_index);
    load_mask(to, v);
    return to;
}

void Operands::store_mask_slot(Value v, const x86::KReg& value) {
    if (cursor_.interval(v).slot >= 0) a_.kmovw(slot(v), value);
}

}  // namespace kinora::jit::x64
