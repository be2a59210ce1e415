// jit/a64/function_writer_p.h: writes one function as machine code.
#pragma once

#include "jit/a64/arithmetic_p.h"
#include "jit/a64/arrays_p.h"
#include "jit/a64/calls_p.h"
#include "jit/a64/control_flow_p.h"
#include "jit/a64/function_frame_p.h"
#include "jit/a64/records_p.h"

namespace kinora::jit::a64 {

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
    Branches branches_;
    FloatArithmetic floats_;
    IntegerArithmetic integers_;
    Masks masks_;
    Blends blends_;
    Assignments assignments_;
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

}  // namespace kinora::jit::a64
