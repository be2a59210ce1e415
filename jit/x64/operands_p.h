// jit/x64/operands_p.h: from a value to the register or memory that holds it now.
#pragma once

#include <span>

#include "jit/codegen/code_cursor_p.h"
#include "jit/x64/isa_p.h"
#include "jit/x64/pool_p.h"
#include "jit/x64/registers_p.h"

namespace kinora::jit::x64 {

class Operands {
  public:
    // `frame_row`: AVX2: the row at kFrameRows of each frame slot.
    Operands(x86::Assembler& a, const Isa& isa, Pool& pool, std::span<const int32_t> frame_row,
             const CodeCursor& cursor)
        : a_(a), isa_(isa), pool_(pool), frame_row_(frame_row), cursor_(cursor) {}

    // Registers by number.
    x86::Vec vec(int index) const;
    static x86::Xmm xmm(const x86::Vec& v) { return x86::xmm(v.id()); }
    static x86::KReg k(int index) { return x86::k(static_cast<uint32_t>(index)); }
    x86::Vec scratch(int k) const { return vec(isa_.vector_registers + k); }
    // Pointers of memory operands take turns, so that the operands of one instruction do not meet.
    // The turn starts anew at rax (0) or, where that is in use, at rcx (1).
    void restart_pointers(unsigned first) { gp_turn_ = first; }
    x86::Gp next_pointer();

    // Memory.
    x86::Mem row(int32_t offset) const { return x86::ptr(x86::r15, offset); }  // of the frame
    x86::Mem swap_row(int k) const { return row(cursor_.code().layout.swap + kRow * k); }
    x86::Mem constant(uint32_t bits) const;
    x86::Mem memory(Value v);  // where v lies if not in a register, with its broadcast

    // Values in vector registers. A mask is in one if there are no mask registers.
    Operand operand(Value v);                  // register or memory
    x86::Vec reg(Value v, int scratch_index);  // register, loaded into that scratch if need be
    bool lies_in(const x86::Vec& r, Value v) const;
    void load(const x86::Vec& to, Value v);
    void load_constant(Value v);  // into the register it was given
    void load_input(Value v);     // likewise
    void load_memory(const x86::Vec& to, const x86::Mem& from);
    x86::Vec target() const;              // where the instruction's value goes ...
    void finish(const x86::Vec& value) {  // ... and to its slot, if it has one
        store_slot(cursor_.at(), value);
    }
    x86::Mem slot(Value v) const;
    void store_slot(Value v, const x86::Vec& value);

    // Values in mask registers, likewise.
    bool is_mask(Value v) const { return isa_.wide && cursor_.inst(v).type == Type::M; }
    bool gives_mask() const { return is_mask(cursor_.at()); }
    x86::KReg mask_reg(Value v, int scratch_index);
    void load_mask(const x86::KReg& to, Value v);
    x86::KReg mask_target() const;
    void finish_mask(const x86::KReg& value) { store_mask_slot(cursor_.at(), value); }
    void store_mask_slot(Value v, const x86::KReg& value);

  private:
    x86::Assembler& a_;
    const Isa& isa_;
    Pool& pool_;
    std::span<const int32_t> frame_row_;
    const CodeCursor& cursor_;
    unsigned gp_turn_ = 0;
};

}  // namespace kinora::jit::x64
