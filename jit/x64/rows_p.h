// jit/x64/rows_p.h: rows of lanes in memory that is shared with C++, and the leaves read from
// there.
#pragma once

#include "jit/x64/operands_p.h"

namespace kinora::jit::x64 {

// In such rows a mask lane is all ones or zero, whatever masks are in registers.
class Rows {
  public:
    Rows(x86::Assembler& a, const CodeCursor& cursor, Operands& operands)
        : a_(a), cursor_(cursor), operands_(operands) {}

    // Constants, frame values and inputs are operands in memory; those that were given a register
    // are loaded where their range begins. Masks in mask registers are loaded here.
    void op_ConstF() {}
    void op_ConstI() {}
    void op_ConstM() {}
    void op_Param();
    void op_Input();
    void op_FrameLoad();

    // Where the lanes of the instruction's value may be written before finish().
    x86::Vec target() const {
        return operands_.gives_mask() ? operands_.scratch(0) : operands_.target();
    }
    // The instruction's value from lanes in a vector register; a mask from its lanes' signs.
    void finish(const x86::Vec& lanes);
    void load_result(const x86::Mem& from);  // likewise, from a row
    x86::Vec lanes_of(Value v);              // in a register; a mask's in scratch 0
    void store(const x86::Mem& to, Value v);

  private:
    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
};

}  // namespace kinora::jit::x64
