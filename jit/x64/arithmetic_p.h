// jit/x64/arithmetic_p.h: arithmetic of floats and integers.
#pragma once

#include "jit/x64/operands_p.h"

namespace kinora::jit::x64 {

// IR instructions that are one machine instruction: writes the one in work as `id`.
class PlainOps {
  public:
    PlainOps(x86::Assembler& a, const CodeCursor& cursor, Operands& operands)
        : a_(a), cursor_(cursor), operands_(operands) {}

    void binary(InstId id, bool commutative);
    void unary(InstId id);
    void unary_imm(InstId id, int imm);
    void with_constant(InstId id, uint32_t bits);
    void shift(InstId id);
    // Another instruction's value, into `to`. `under`, if given: lanes that are off keep what `to`
    // holds.
    void binary_into(const x86::Vec& to, InstId id, const Inst& inst, bool commutative,
                     const x86::KReg* under);

  private:
    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
};

// Arithmetic and rounding of floats.
class FloatArithmetic {
  public:
    FloatArithmetic(x86::Assembler& a, const Isa& isa, const CodeCursor& cursor, Operands& operands,
                    PlainOps& plain)
        : a_(a), isa_(isa), cursor_(cursor), operands_(operands), plain_(plain) {}

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

    // Add, Sub, Mul, Neg or Fma into `to`. `under`, if given: lanes that are off keep what it
    // holds.
    void compute_into(const x86::Vec& to, const Inst& inst, const x86::KReg* under);

  private:
    void round(int mode);
    void fma_into(const x86::Vec& to, const Inst& fma, const x86::KReg* under);
    void negate_into(const x86::Vec& to, Value v, const x86::KReg* under);

    x86::Assembler& a_;
    const Isa& isa_;
    const CodeCursor& cursor_;
    Operands& operands_;
    PlainOps& plain_;
};

// Arithmetic of integers, and conversions from and to floats.
class IntegerArithmetic {
  public:
    IntegerArithmetic(const Isa& isa, const CodeCursor& cursor, Operands& operands, PlainOps& plain)
        : isa_(isa), cursor_(cursor), operands_(operands), plain_(plain) {}

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
    const Isa& isa_;
    const CodeCursor& cursor_;
    Operands& operands_;
    PlainOps& plain_;
};

}  // namespace kinora::jit::x64
