// jit/x64/operands.cpp: from a value to the register or memory that holds it now.
#include "jit/x64/emit_p.h"
#include "runtime/base/check.h"

namespace kinora::jit::x64 {

x86::Vec Emit::vec(int index) const {
    auto id = static_cast<uint32_t>(index);
    return isa_.wide ? static_cast<x86::Vec>(x86::zmm(id)) : static_cast<x86::Vec>(x86::ymm(id));
}

// Pointers of memory operands take turns, so that the operands of one instruction do not meet.
x86::Gp Emit::next_gp() {
    static constexpr x86::Gp kTurn[] = {x86::rax, x86::rcx, x86::rdx, x86::rsi};
    return kTurn[gp_turn_++ & 3];
}

x86::Mem Emit::constant(uint32_t bits) const {
    x86::Mem mem = state_.pool.word(bits);
    return isa_.wide ? mem._1to16() : mem;
}

x86::Mem Emit::slot(Value v) const {
    int32_t index = place(v).slot;
    CHECK_GE(index, 0);
    if (is_mask(v)) return row(layout_.masks + 8 * index);
    return row(layout_.vectors + 4 * isa_.lanes * index);
}

x86::Mem Emit::home(Value v) {
    const Inst& i = inst(v);
    for (int k = 0; k < 2; ++k)
        if (saved_[k] == v) return row(layout_.swap + kRow * k);
    switch (i.op) {
        case Op::ConstF:
        case Op::ConstI:
            return constant(static_cast<uint32_t>(i.imm));
        case Op::ConstM:
            return constant(i.imm != 0 ? ~0u : 0u);
        case Op::Loop: {  // unmasked: all lanes run
            if (!plan_.values[v].masked) return constant(~0u);
            return slot(v);
        }
        case Op::FrameLoad: {
            bool stale = planted(PlantedFault::StaleFrameSlot) && i.imm > 0;
            if (isa_.wide) return x86::ptr(x86::r14, 4 * (i.imm - stale))._1to16();
            int32_t index = state_.frame_row[static_cast<size_t>(i.imm)];
            if (stale && index > 0) --index;
            return x86::ptr(x86::r13, kFrameRows + 32 * index);
        }
        case Op::Input: {
            x86::Gp pointer = next_gp();
            a_.mov(pointer, x86::ptr(x86::r12, 8 * i.imm));
            return x86::ptr(pointer, x86::rbp);
        }
        case Op::Param:
            return row(layout_.params + kRow * i.imm);
        default:
            return slot(v);
    }
}

Operand Emit::operand(Value v) {
    v = root(v);
    if (in_register(v)) return vec(place(v).reg);
    return home(v);
}

x86::Vec Emit::reg(Value v, int scratch_index) {
    v = root(v);
    if (in_register(v)) return vec(place(v).reg);
    x86::Vec to = scratch(scratch_index);
    load(to, v);
    return to;
}

void Emit::load_memory(const x86::Vec& to, const x86::Mem& from) {
    if (from.hasBroadcast()) {
        x86::Mem word = from;
        word.resetBroadcast();
        a_.emit(Id::kIdVbroadcastss, to, word);
    } else {
        a_.emit(Id::kIdVmovaps, to, from);
    }
}

void Emit::load_constant(Value v) {
    x86::Vec to = vec(place(v).reg);
    if (is_zero(v))
        a_.vxorps(xmm(to), xmm(to), xmm(to));
    else
        load_memory(to, home(v));
}

void Emit::load(const x86::Vec& to, Value v) {
    v = root(v);
    if (in_register(v)) {
        x86::Vec from = vec(place(v).reg);
        if (from.id() != to.id()) a_.emit(Id::kIdVmovaps, to, from);
    } else if (is_zero(v)) {
        a_.vxorps(xmm(to), xmm(to), xmm(to));
    } else {
        load_memory(to, home(v));
    }
}

x86::Vec Emit::target_of(Value v) const {
    const Place& p = place(v);
    return p.reg >= 0 && p.in_reg(p.begin) ? vec(p.reg) : scratch(0);
}

void Emit::store_slot(Value v, const x86::Vec& value) {
    if (planted(PlantedFault::MissingSpill) && place(v).reg >= 0) return;
    if (place(v).slot >= 0) a_.emit(Id::kIdVmovaps, slot(v), value);
}

x86::KReg Emit::mask_target() const {
    const Place& p = place(at_);
    return p.reg >= 0 && p.in_reg(p.begin) ? x86::k(static_cast<uint32_t>(p.reg)) : x86::k7;
}

void Emit::load_mask(const x86::KReg& to, Value v) {
    v = root(v);
    const Inst& i = inst(v);
    if (in_register(v)) {
        x86::KReg from = x86::k(static_cast<uint32_t>(place(v).reg));
        if (from.id() != to.id()) a_.kmovw(to, from);
    } else if (i.op == Op::ConstM && i.imm == 0) {
        a_.kxorw(to, to, to);
    } else if (i.op == Op::ConstM || (i.op == Op::Loop && !plan_.values[v].masked)) {
        a_.kxnorw(to, to, to);
    } else {
        a_.kmovw(to, home(v));
    }
}

x86::KReg Emit::mask_reg(Value v, int scratch_index) {
    v = root(v);
    if (in_register(v)) return x86::k(static_cast<uint32_t>(place(v).reg));
    x86::KReg to = x86::k(static_cast<uint32_t>(scratch_index));
    load_mask(to, v);
    return to;
}

void Emit::store_mask_slot(Value v, const x86::KReg& value) {
    if (place(v).slot >= 0) a_.kmovw(slot(v), value);
}

// A Merge or LoopVar with both a register and a slot fills the slot when its last write is done.
void Emit::copy(Value to, Value from) {
    bool memory_only = place(to).reg < 0;
    if (is_mask(to)) {
        x86::KReg k =
            memory_only ? mask_reg(from, 7) : x86::k(static_cast<uint32_t>(place(to).reg));
        if (memory_only)
            store_mask_slot(to, k);
        else
            load_mask(k, from);
        return;
    }
    if (memory_only)
        store_slot(to, reg(from, 0));
    else
        load(vec(place(to).reg), from);
}

}  // namespace kinora::jit::x64
