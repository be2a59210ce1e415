// jit/x64/faults_p.h: reports at run time, by KernelArgs::fault.
#pragma once

#include "jit/x64/masks_p.h"

namespace kinora::jit::x64 {

class Faults {
  public:
    Faults(x86::Assembler& a, const CodeCursor& cursor, Masks& masks)
        : a_(a), cursor_(cursor), masks_(masks) {}

    void op_Fault();
    void report(int32_t site);

  private:
    x86::Assembler& a_;
    const CodeCursor& cursor_;
    Masks& masks_;
};

}  // namespace kinora::jit::x64
