// jit/a64/faults.cpp: reports at run time, by KernelArgs::fault.
#include "jit/a64/faults_p.h"

#include <cstddef>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

void Faults::report(int32_t site) {
    a_.ldr(arm::x16, arm::ptr(kArgs, offsetof(KernelArgs, fault)));
    a_.mov(arm::w0, 1);
    a_.strb(arm::w0, operands_.address(arm::x16, site, 1));
}

void Faults::op_Fault() {
    Label none = a_.newLabel();
    masks_.lane_bits(arm::w0, cursor_->a);
    a_.ldr(arm::w1, arm::ptr(kGlobals, kValidBits));
    if (planted(PlantedFault::FaultIgnoresMask)) a_.mov(arm::w0, arm::w1);
    a_.and_(arm::w0, arm::w0, arm::w1);
    a_.cbz(arm::w0, none);
    report(cursor_->imm);
    a_.bind(none);
}

}  // namespace kinora::jit::a64
