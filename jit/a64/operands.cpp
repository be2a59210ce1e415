// jit/a64/operands.cpp: from a value to the register that holds it now, or its memory.
#include "jit/a64/emit_p.h"
#include "runtime/base/check.h"

namespace kinora::jit::a64 {

// v0..v7 and v16..v28 are free to use, v8..v15 must be kept for the caller: they are given last.
Vec Emit::vec(int index) const {
    int id = index < 8 ? index : index < kFirstSavedRegister ? index + 8 : index - 13;
    return arm::v(static_cast<uint32_t>(id));
}

bool Emit::lies_in(const Vec& r, Value v) const {
    return in_register(v) && vec(place(root(v)).reg).id() == r.id();
}

// The immediate of a load or store counts its own size, 0..4095 times.
arm::Mem Emit::at(const Gp& base, int64_t offset, int bytes) {
    if (offset >= 0 && offset % bytes == 0 && offset / bytes < 4096)
        return arm::ptr(base, static_cast<int32_t>(offset));
    a_.mov(arm::x17, offset);
    return arm::ptr(base, arm::x17);
}

void Emit::add_offset(const Gp& to, const Gp& base, int64_t offset) {
    if (offset >= 0 && offset < 4096) {
        a_.add(to, base, offset);
    } else {
        a_.mov(arm::x17, offset);
        a_.add(to, base, arm::x17);
    }
}

int32_t Emit::slot(Value v) const {
    CHECK_GE(place(v).slot, 0);
    return layout_.vectors + kVector * place(v).slot;
}

void Emit::zero(const Vec& to) {
    a_.movi(to.s4(), 0);
}

void Emit::move(const Vec& to, const Vec& from) {
    if (to.id() != from.id()) a_.mov(to.b16(), from.b16());
}

void Emit::constant(const Vec& to, uint32_t bits) {
    if (bits == 0)
        zero(to);
    else
        a_.ldr(to, at(kPool, state_.pool.word(bits), kVector));
}

void Emit::broadcast(const Vec& to, const arm::Mem& word) {
    a_.ldr(to.s(), word);
    a_.dup(to.s4(), to.s(0));
}

// From where the value lies in memory.
void Emit::load_home(const Vec& to, Value v) {
    const Inst& i = inst(v);
    for (int k = 0; k < 2; ++k)
        if (saved_[k] == v) return void(a_.ldr(to, row(layout_.swap + kRow * k)));
    bool stale = planted(PlantedFault::StaleFrameSlot) && i.imm > 0;
    switch (i.op) {
        case Op::ConstF:
        case Op::ConstI:
            return constant(to, static_cast<uint32_t>(i.imm));
        case Op::ConstM:
            return constant(to, i.imm != 0 ? ~0u : 0u);
        case Op::FrameLoad:
            return broadcast(to, at(kFrameBlock, int64_t{4} * (i.imm - stale), 4));
        case Op::Input:
            a_.ldr(arm::x17, at(kIn, int64_t{8} * i.imm, 8));
            a_.ldr(to, arm::ptr(arm::x17, kGroup));
            return;
        case Op::Param:
            a_.ldr(to, row(layout_.params + kRow * i.imm));
            return;
        case Op::Loop:  // unmasked: all lanes run
            if (!plan_.values[v].masked) return constant(to, ~0u);
            break;
        default:
            break;
    }
    a_.ldr(to, row(slot(v)));
}

Vec Emit::reg(Value v, int scratch_index) {
    v = root(v);
    if (in_register(v)) return vec(place(v).reg);
    load_home(scratch(scratch_index), v);
    return scratch(scratch_index);
}

void Emit::load(const Vec& to, Value v) {
    v = root(v);
    if (in_register(v))
        move(to, vec(place(v).reg));
    else
        load_home(to, v);
}

Vec Emit::target() const {
    const Place& p = place(at_);
    return p.reg >= 0 && p.in_reg(p.begin) ? vec(p.reg) : scratch(0);
}

void Emit::store_slot(Value v, const Vec& value) {
    if (planted(PlantedFault::MissingSpill) && place(v).reg >= 0) return;
    if (place(v).slot >= 0) a_.str(value, row(slot(v)));
}

// A Merge or LoopVar with both a register and a slot fills the slot when its last write is done.
void Emit::copy(Value to, Value from) {
    if (place(to).reg < 0)
        store_slot(to, reg(from, 0));
    else
        load(vec(place(to).reg), from);
}

}  // namespace kinora::jit::a64
