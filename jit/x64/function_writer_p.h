// jit/x64/function_writer_p.h: writes one function as machine code.
#pragma once

#include "jit/codegen/write_code_p.h"
#include "jit/x64/arithmetic_p.h"
#include "jit/x64/arrays_p.h"
#include "jit/x64/calls_p.h"
#include "jit/x64/control_flow_p.h"
#include "jit/x64/function_frame_p.h"

namespace kinora::jit::x64 {

// The objects that write code, each after those it needs. An op of ops.def belongs to the one that
// has its op_NAME().
class FunctionWriter {
  public:
    FunctionWriter(ModuleState& state, const FunctionCode& code);

    void write(bool listing);

  private:
    ModuleState& state_;
    CodeCursor cursor_;
    Operands operands_;
    PlainOps plain_;
    FloatArithmetic floats_;
    IntegerArithmetic integers_;
    Masks masks_;
    Blends blends_;
    Assignments assignments_;
    Rows rows_;
    OpenLoops loops_;
    Indices indices_;
    Gathers gathers_;
    Arrays arrays_;
    HeldRecord held_;
    Records records_;
    Faults faults_;
    ControlFlow control_flow_;
    Calls calls_;
    FunctionFrame frame_;
};

}  // namespace kinora::jit::x64
