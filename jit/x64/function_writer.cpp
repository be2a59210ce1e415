// jit/x64/function_writer.cpp: writes one function as machine code.
#include "jit/x64/function_writer_p.h"

namespace kinora::jit::x64 {

FunctionWriter::FunctionWriter(ModuleState& state, const FunctionCode& code)
    : state_(state),
      cursor_(code),
      operands_(state.a, state.isa, state.pool, state.frame_row, cursor_),
      plain_(state.a, cursor_, operands_),
      floats_(state.a, state.isa, cursor_, operands_, plain_),
      integers_(state.isa, cursor_, operands_, plain_),
      masks_(state.a, state.isa, cursor_, operands_, plain_),
      blends_(state.a, state.isa, cursor_, operands_, floats_),
      assignments_(state.a, state.isa, cursor_, operands_, masks_, blends_),
      rows_(state.a, cursor_, operands_),
      loops_(state.a, cursor_),
      indices_(state.a, cursor_, operands_, masks_, loops_),
      gathers_(state.a, state.isa, state.pool, cursor_, operands_, rows_, indices_),
      arrays_(state.a, state.isa, state.pool, cursor_, operands_, masks_, blends_, rows_, indices_,
              gathers_),
      records_(state.a, cursor_, operands_, rows_, indices_, held_),
      faults_(state.a, cursor_, masks_),
      control_flow_(state.a, cursor_, operands_, masks_, assignments_, loops_, records_, held_,
                    faults_),
      calls_(state.a, state.isa, state.entries, cursor_, operands_, masks_, rows_, held_),
      frame_(state, code, operands_) {}

void FunctionWriter::write(bool listing) {
    GoneOps gone;
    OpWriters ops(floats_, integers_, masks_, blends_, rows_, gathers_, arrays_, records_, faults_,
                  control_flow_, calls_, gone);
    frame_.enter();
    arrays_.zero();
    write_instructions(
        cursor_, state_.a, listing, state_.lines, [&](Value v) { operands_.load_input(v); },
        [&](Op op) { ops.write(op); });
    frame_.leave();
}

}  // namespace kinora::jit::x64
