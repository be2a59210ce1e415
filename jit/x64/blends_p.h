// jit/x64/blends_p.h: one of two values in each lane, by a mask.
#pragma once

#include "jit/x64/arithmetic_p.h"

namespace kinora::jit::x64 {

class Blends {
  public:
    Blends(x86::Assembler& a, const Isa& isa, const CodeCursor& cursor, Operands& operands,
           FloatArithmetic& floats)
        : a_(a), isa_(isa), cursor_(cursor), operands_(operands), floats_(floats) {}

    void op_Select();

    // to = mask ? then : otherwise
    void blend(const x86::Vec& to, const x86::Vec& otherwise, Value then, Value mask);
    void blend_mask(const x86::KReg& to, Value otherwise, Value then, Value mask);

  private:
    void select(const x86::Vec& to);
    void select_computed(const x86::Vec& to);

    x86::Assembler& a_;
    const Isa& isa_;
    const CodeCursor& cursor_;
    Operands& operands_;
    FloatArithmetic& floats_;
};

}  // namespace kinora::jit::x64
