// jit/a64/function_writer.cpp: writes one function as machine code.
#include "jit/a64/function_writer_p.h"

#include "jit/codegen/write_code_p.h"

namespace kinora::jit::a64 {

namespace {

// Constants, frame values and inputs are loaded where they are used; those that were given a
// register, where their range begins.
struct Leaves {
    void op_ConstF() {}
    void op_ConstI() {}
    void op_ConstM() {}
    void op_Param() {}
    void op_Input() {}
    void op_FrameLoad() {}
};

}  // namespace

FunctionWriter::FunctionWriter(ModuleState& state, const FunctionCode& code)
    : state_(state),
      cursor_(code),
      operands_(state.a, state.pool, cursor_),
      branches_(state.a, code),
      floats_(state.a, cursor_, operands_),
      integers_(state.a, cursor_, operands_),
      masks_(state.a, operands_),
      blends_(state.a, cursor_, operands_),
      assignments_(state.a, cursor_, operands_, masks_, blends_),
      loops_(state.a, code, operands_, branches_),
      indices_(state.a, cursor_, operands_, masks_),
      gathers_(state.a, state.pool, cursor_, operands_, indices_),
      arrays_(state.a, cursor_, operands_, blends_, indices_, gathers_),
      records_(state.a, cursor_, operands_, indices_, held_),
      faults_(state.a, cursor_, operands_, masks_),
      control_flow_(state.a, cursor_, operands_, masks_, assignments_, branches_, loops_, held_,
                    faults_),
      calls_(state.a, state.entries, cursor_, operands_, masks_, branches_, held_),
      frame_(state, code, operands_) {}

void FunctionWriter::write(bool listing) {
    Leaves leaves;
    GoneOps gone;
    OpWriters ops(leaves, floats_, integers_, masks_, blends_, gathers_, arrays_, records_, faults_,
                  control_flow_, calls_, gone);
    frame_.enter();
    arrays_.zero();
    write_instructions(
        cursor_, state_.a, listing, state_.lines, [&](Value v) { operands_.load_register(v); },
        [&](Op op) { ops.write(op); });
    frame_.leave();
}

}  // namespace kinora::jit::a64
