// jit/a64/function_frame_p.h: entry and exit of a function, and the loop over groups of lanes.
#pragma once

#include <vector>

#include "jit/a64/operands_p.h"
#include "jit/codegen/module_code_p.h"
#include "jit/codegen/unwind.h"

namespace kinora::jit::a64 {

// What the functions of a module share while their code is written.
struct ModuleState {
    arm::Assembler& a;
    Pool pool;
    std::vector<Label> entries;    // of functions
    bool uses_valid = false;       // something asks which lanes hold points
    bool saves_registers = false;  // something uses v8..v15
    std::vector<CodeLine> lines = {};
    UnwindWriter unwind{kUnwindA64};
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
    void note_saved();
    int saved_bytes() const;
    void find_valid_lanes();

    ModuleState& state_;
    arm::Assembler& a_;
    const FunctionCode& code_;
    Operands& operands_;
    Label group_, done_;  // the kernel's loop over groups of lanes
};

}  // namespace kinora::jit::a64
