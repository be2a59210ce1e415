// jit/a64/faults_p.h: reports at run time, by KernelArgs::fault.
#pragma once

#include "jit/a64/masks_p.h"

namespace kinora::jit::a64 {

class Faults {
  public:
    Faults(arm::Assembler& a, const CodeCursor& cursor, Operands& operands, Masks& masks)
        : a_(a), cursor_(cursor), operands_(operands), masks_(masks) {}

    void op_Fault();
    void report(int32_t site);

  private:
    arm::Assembler& a_;
    const CodeCursor& cursor_;
    Operands& operands_;
    Masks& masks_;
};

}  // namespace kinora::jit::a64
