// jit/x64/function_frame_p.h: entry and exit of a function, and the loop over groups of lanes.
#pragma once

#include <vector>

#include "jit/codegen/module_code_p.h"
#include "jit/codegen/unwind.h"
#include "jit/x64/operands_p.h"

namespace kinora::jit::x64 {

// What the functions of a module share while their code is written.
struct ModuleState {
    x86::Assembler& a;
    const Isa& isa;
    Pool& pool;
    std::vector<Label> entries;      // of functions
    std::vector<int32_t> frame_row;  // AVX2: frame slot -> row at kFrameRows, -1 if unused
    int32_t globals_bytes = kFrameRows;
    bool uses_valid = false;  // something asks which lanes hold points
    std::vector<CodeLine> lines = {};
    UnwindWriter unwind{kUnwindX64};
};

class FunctionFrame {
  public:
    FunctionFrame(ModuleState& state, const FunctionCode& code, Operands& operands)
        : state_(state), a_(state.a), code_(code), operands_(operands) {}

    // Around the body.
    void enter() { code_.is_kernel ? enter_kernel() : enter_local(); }
    void leave() { code_.is_kernel ? leave_kernel() : leave_local(); }

  private:
    void enter_kernel();
    void leave_kernel();
    void enter_local();
    void leave_local();
    void save_registers();
    void restore_registers();
    void move_stack(int bytes);
    void find_valid_lanes();
    void broadcast_frame();

    ModuleState& state_;
    x86::Assembler& a_;
    const FunctionCode& code_;
    Operands& operands_;
    Label group_;  // the kernel's loop over groups of lanes
};

}  // namespace kinora::jit::x64
