// jit/x64/masks_p.h: comparisons, mask logic, and what general registers learn of a mask.
#pragma once

#include "jit/x64/arithmetic_p.h"

namespace kinora::jit::x64 {

// Masks are k registers in AVX-512 and lanes of all ones or zero in AVX2.
class Masks {
  public:
    Masks(x86::Assembler& a, const Isa& isa, const CodeCursor& cursor, Operands& operands,
          PlainOps& plain)
        : a_(a), isa_(isa), cursor_(cursor), operands_(operands), plain_(plain) {}

    void op_Lt();
    void op_Le();
    void op_Eq();
    void op_ILt();
    void op_IEq();
    void op_MAnd();
    void op_MOr();
    void op_MXor();
    void op_MAndNot();
    void op_MNot();

    void set_if_any(Value mask);  // flags: not zero if a lane is set
    void lane_bits(const x86::Gp& to, Value mask);

  private:
    void compare();
    void compare_into(const Operand& to, const Inst& compare, bool negate, const x86::KReg* under);
    void logic(InstId wide_id, InstId id);

    x86::Assembler& a_;
    const Isa& isa_;
    const CodeCursor& cursor_;
    Operands& operands_;
    PlainOps& plain_;
};

}  // namespace kinora::jit::x64
