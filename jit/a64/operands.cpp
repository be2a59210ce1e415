// jit/a64/operands.cpp: from a value to the register that holds it now, or its memory.
#include "jit/a64/operands_p.h"

#include "jit/ir/planted_fault.h"
#include "runtime/base/check.h"

namespace kinora::jit::a64 {

// v0..v7 and v16..v28 are free to use, v8..v15 must be kept for the caller: they are given last.
Vec Operands::vec(int index) {
    int id = index < 8 ? index : index < kFirstSavedRegister ? index + 8 : index - 13;
    return arm::v(static_cast<uint32_t>(id));
}

// The immediate of a load or store counts its own size, 0..4095 times.
arm::Mem Operands::address(const Gp& base, int64_t offset, int bytes) {
    if (offset >= 0 && offset % bytes == 0 && offset / bytes < 4096)
        return arm::ptr(base, static_cast<int32_t>(offset));
    a_.mov(arm::x17, offset);
    return arm::ptr(base, arm::x17);
}

void Operands::add_offset(const Gp& to, const Gp& base, int64_t offset) {
    if (offset >= 0 && offset < 4096) {
        a_.add(to, base, offset);
    } else {
        a_.mov(arm::x17, offset);
        a_.add(to, base, arm::x17);
    }
}

int32_t Operands::slot(Value v) const {
    int32_t index = cursor_.interval(v).slot;
    CHECK_GE(index, 0);
    return cursor_.code().layout.vectors + kVector * index;
}

void Operands::zero(const Vec& to) {
    a_.movi(to.s4(), 0);
}

void Operands::move(const Vec& to, const Vec& from) {
    if (to.id() != from.id()) a_.mov(to.b16(), from.b16());
}

void Operands::constant(const Vec& to, uint32_t bits) {
    if (bits == 0)
        zero(to);
    else
        a_.ldr(to, address(kPool, pool_.word(bits), kVector));
}

void Operands::broadcast(const Vec& to, const arm::Mem& word) {
    a_.ldr(to.s(), word);
    a_.dup(to.s4(), to.s(0));
}

void Operands::load_memory(const Vec& to, Value v) {
    const Inst& i = cursor_.inst(v);
    if (int k = cursor_.old_row(v); k >= 0) return void(a_.ldr(to, swap_row(k)));
    bool stale = planted(PlantedFault::StaleFrameSlot) && i.imm > 0;
    switch (i.op) {
        case Op::ConstF:
        case Op::ConstI:
            return constant(to, static_cast<uint32_t>(i.imm));
        case Op::ConstM:
            return constant(to, i.imm != 0 ? ~0u : 0u);
        case Op::FrameLoad:
            return broadcast(to, address(kFrameBlock, int64_t{4} * (i.imm - stale), 4));
        case Op::Input:
            a_.ldr(arm::x17, address(kIn, int64_t{8} * i.imm, 8));
            a_.ldr(to, arm::ptr(arm::x17, kGroup));
            return;
        case Op::Param:
            a_.ldr(to, row(cursor_.code().layout.params + kRow * i.imm));
            return;
        case Op::Loop:  // unmasked: all lanes run
            if (!cursor_.plan(v).masked) return constant(to, ~0u);
            break;
        default:
            break;
    }
    a_.ldr(to, row(slot(v)));
}

Vec Operands::reg(Value v, int scratch_index) {
    v = cursor_.root(v);
    if (cursor_.in_register(v)) return vec(cursor_.interval(v).reg);
    load_memory(scratch(scratch_index), v);
    return scratch(scratch_index);
}

bool Operands::lies_in(const Vec& r, Value v) const {
    return cursor_.in_register(v) && vec(cursor_.interval(cursor_.root(v)).reg).id() == r.id();
}

void Operands::load(const Vec& to, Value v) {
    v = cursor_.root(v);
    if (cursor_.in_register(v))
        move(to, vec(cursor_.interval(v).reg));
    else
        load_memory(to, v);
}

void Operands::load_register(Value v) {
    load_memory(vec(cursor_.interval(v).reg), v);
}

Vec Operands::target() const {
    const LiveInterval& value = cursor_.interval(cursor_.at());
    return value.in_reg(value.begin) ? vec(value.reg) : scratch(0);
}

void Operands::store_slot(Value v, const Vec& value) {
    const LiveInterval& interval = cursor_.interval(v);
    if (planted(PlantedFault::MissingSpill) && interval.reg >= 0) return;
    if (interval.slot >= 0) a_.str(value, row(slot(v)));
}

}  // namespace kinora::jit::a64
