// jit/a64/masks_p.h: comparisons, mask logic, and what general registers learn of a mask.
#pragma once

#include "jit/a64/operands_p.h"

namespace kinora::jit::a64 {

// A mask's lanes are all ones or zero.
class Masks {
  public:
    Masks(arm::Assembler& a, Operands& operands) : a_(a), operands_(operands) {}

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

    void find_any(const Vec& mask);  // kAny: not zero if any lane is set
    // Bit k of `to` is lane k. Changes scratch 1 and 2.
    void lane_bits(const Gp& to, Value mask);

  private:
    arm::Assembler& a_;
    Operands& operands_;
};

}  // namespace kinora::jit::a64
