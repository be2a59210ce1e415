// jit/a64/operands_p.h: from a value to the register that holds it now, or its memory.
#pragma once

#include "jit/a64/pool_p.h"
#include "jit/a64/registers_p.h"
#include "jit/codegen/code_cursor_p.h"

namespace kinora::jit::a64 {

class Operands {
  public:
    Operands(arm::Assembler& a, Pool& pool, const CodeCursor& cursor)
        : a_(a), pool_(pool), cursor_(cursor) {}

    // Registers by number.
    static Vec vec(int index);
    static Vec scratch(int k) { return arm::v(static_cast<uint32_t>(kVectorRegisters + k)); }

    // Addresses; these may change x17.
    arm::Mem address(const Gp& base, int64_t offset, int bytes);
    void add_offset(const Gp& to, const Gp& base, int64_t offset);
    arm::Mem row(int32_t offset) { return address(kStack, offset, kVector); }  // of the frame
    arm::Mem swap_row(int k) { return row(cursor_.code().layout.swap + kRow * k); }
    int32_t slot(Value v) const;  // offset in the frame

    // Lanes.
    void zero(const Vec& to);
    void move(const Vec& to, const Vec& from);
    void constant(const Vec& to, uint32_t bits);
    void broadcast(const Vec& to, const arm::Mem& word);

    // Values.
    Vec reg(Value v, int scratch_index);  // register, loaded into that scratch if need be
    bool lies_in(const Vec& r, Value v) const;
    void load(const Vec& to, Value v);
    void load_register(Value v);     // a constant or input, into the one it was given
    Vec target() const;              // where the instruction's value goes ...
    void finish(const Vec& value) {  // ... and to its slot, if it has one
        store_slot(cursor_.at(), value);
    }
    void store_slot(Value v, const Vec& value);

    // An instruction that is one machine instruction, or a few: `write` emits it, given the
    // target's and the operands' registers.
    template <class Write>
    void unary(Write&& write) {
        Vec to = target();
        write(to, reg(cursor_->a, 1));
        finish(to);
    }
    template <class Write>
    void binary(Write&& write) {
        Vec to = target();
        Vec left = reg(cursor_->a, 1);
        write(to, left, reg(cursor_->b, 2));
        finish(to);
    }

  private:
    void load_memory(const Vec& to, Value v);

    arm::Assembler& a_;
    Pool& pool_;
    const CodeCursor& cursor_;
};

}  // namespace kinora::jit::a64
