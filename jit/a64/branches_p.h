// jit/a64/branches_p.h: conditional branches, which reach 1 MiB only, over functions of any size.
#pragma once

#include "jit/a64/registers_p.h"
#include "jit/codegen/function_code_p.h"

namespace kinora::jit::a64 {

class Branches {
  public:
    Branches(arm::Assembler& a, const FunctionCode& code);

    void if_zero(const Gp& condition, const Label& to);
    void if_not_zero(const Gp& condition, const Label& to);

  private:
    arm::Assembler& a_;
    const bool far_;  // a label may be out of reach
};

}  // namespace kinora::jit::a64
