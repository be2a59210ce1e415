// jit/a64/blends_p.h: one of two values in each lane, by a mask.
#pragma once

#include "jit/a64/operands_p.h"

namespace kinora::jit::a64 {

class Blends {
  public:
    Blends(arm::Assembler& a, const CodeCursor& cursor, Operands& operands)
        : a_(a), cursor_(cursor), operands_(operands) {}

    void op_Select();

    // to = mask ? then : otherwise
    void blend(const Vec& to, const Vec& otherwise, Value then, Value mask);

  private:
    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
};

}  // namespace kinora::jit::a64
