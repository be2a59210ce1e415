// jit/a64/arithmetic_p.h: arithmetic of floats and integers.
#pragma once

#include "jit/a64/operands_p.h"

namespace kinora::jit::a64 {

// Arithmetic and rounding of floats.
class FloatArithmetic {
  public:
    FloatArithmetic(arm::Assembler& a, const CodeCursor& cursor, Operands& operands)
        : a_(a), cursor_(cursor), operands_(operands) {}

    void op_Add();
    void op_Sub();
    void op_Mul();
    void op_Div();
    void op_Fma();
    void op_Min();
    void op_Max();
    void op_Neg();
    void op_Abs();
    void op_Sqrt();
    void op_Floor();
    void op_Ceil();
    void op_Trunc();
    void op_Round();

  private:
    void min_max(bool max);

    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
};

// Arithmetic of integers, and conversions from and to floats.
class IntegerArithmetic {
  public:
    IntegerArithmetic(arm::Assembler& a, const CodeCursor& cursor, Operands& operands)
        : a_(a), cursor_(cursor), operands_(operands) {}

    void op_IAdd();
    void op_ISub();
    void op_IMul();
    void op_IAnd();
    void op_IOr();
    void op_IXor();
    void op_IShl();
    void op_IShr();
    void op_ISar();
    void op_IMin();
    void op_IMax();
    void op_FToI();
    void op_IToF();
    void op_BitsFI();
    void op_BitsIF();

  private:
    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
};

}  // namespace kinora::jit::a64
