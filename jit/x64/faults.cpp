// jit/x64/faults.cpp: reports at run time, by KernelArgs::fault.
#include "jit/x64/faults_p.h"

#include <cstddef>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

void Faults::report(int32_t site) {
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, fault)));
    a_.mov(x86::byte_ptr(x86::rax, site), 1);
}

void Faults::op_Fault() {
    masks_.lane_bits(x86::eax, cursor_->a);
    if (planted(PlantedFault::FaultIgnoresMask)) a_.mov(x86::eax, -1);
    Label none = a_.newLabel();
    a_.test(x86::dword_ptr(x86::r13, kValidBits), x86::eax);
    a_.jz(none);
    report(cursor_->imm);
    a_.bind(none);
}

}  // namespace kinora::jit::x64
