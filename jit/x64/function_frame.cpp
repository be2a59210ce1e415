// jit/x64/function_frame.cpp: entry and exit of a function, and the loop over groups of lanes.
#include "jit/x64/function_frame_p.h"

#include <cstddef>
#include <iterator>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

namespace {

// A register that the caller keeps, and its number in DWARF (System V ABI, AMD64, figure 3.36).
struct Saved {
    x86::Gp gp;
    int dwarf;
};
constexpr Saved kSaved[] = {{x86::rbx, 3},  {x86::rbp, 6},  {x86::r12, 12},
                            {x86::r13, 13}, {x86::r14, 14}, {x86::r15, 15}};

}  // namespace

void FunctionFrame::save_registers() {
    UnwindWriter& unwind = state_.unwind;
    unwind.begin_function(a_.offset());
    int frame = kUnwindX64.entry_bytes;
    for (const Saved& saved : kSaved) {
        a_.push(saved.gp);
        unwind.frame_bytes(a_.offset(), frame += 8);
        unwind.saved(saved.dwarf, frame);
    }
    a_.sub(x86::rsp, 8);  // calls find the stack aligned to 16
    unwind.frame_bytes(a_.offset(), frame + 8);
}

void FunctionFrame::restore_registers() {
    UnwindWriter& unwind = state_.unwind;
    int frame = kUnwindX64.entry_bytes + 8 * static_cast<int>(std::size(kSaved));
    a_.add(x86::rsp, 8);
    unwind.frame_bytes(a_.offset(), frame);
    for (size_t k = std::size(kSaved); k-- > 0;) {
        a_.pop(kSaved[k].gp);
        unwind.frame_bytes(a_.offset(), frame -= 8);
        unwind.restored(kSaved[k].dwarf);
    }
}

void FunctionFrame::enter_kernel() {
    save_registers();
    a_.mov(x86::rbx, x86::rdi);
    a_.mov(x86::r12, x86::ptr(x86::rbx, offsetof(KernelArgs, in)));
    a_.mov(x86::r14, x86::ptr(x86::rbx, offsetof(KernelArgs, frame)));
    a_.mov(x86::r13, x86::ptr(x86::rbx, offsetof(KernelArgs, scratch)));
    a_.lea(x86::r15, x86::ptr(x86::r13, state_.globals_bytes));
    broadcast_frame();
    for (Value v : code_.allocation.function_hoists) operands_.load_constant(v);
    group_ = a_.newLabel();
    a_.xor_(x86::ebp, x86::ebp);
    a_.bind(group_);
    if (state_.uses_valid) find_valid_lanes();
}

void FunctionFrame::leave_kernel() {
    a_.add(x86::rbp, 4 * state_.isa.lanes);
    a_.mov(x86::eax, x86::dword_ptr(x86::rbx, offsetof(KernelArgs, count)));
    a_.shl(x86::rax, 2);
    a_.cmp(x86::rbp, x86::rax);
    a_.jb(group_);
    a_.vzeroupper();
    restore_registers();
    a_.ret();
}

// A function of the module: same registers, its own frame behind the caller's.
void FunctionFrame::enter_local() {
    a_.bind(state_.entries[code_.index]);
    state_.unwind.begin_function(a_.offset());
    if (code_.plan.calls) move_stack(-8);
}

void FunctionFrame::leave_local() {
    if (code_.plan.calls) move_stack(8);
    a_.ret();
}

// Of a function that keeps nothing on the stack but its own frame, or has given it back.
void FunctionFrame::move_stack(int bytes) {
    if (bytes < 0)
        a_.sub(x86::rsp, -bytes);
    else
        a_.add(x86::rsp, bytes);
    state_.unwind.frame_bytes(a_.offset(), kUnwindX64.entry_bytes + (bytes < 0 ? -bytes : 0));
}

// Which lanes of this group hold points: those before `count`.
void FunctionFrame::find_valid_lanes() {
    a_.mov(x86::ecx, x86::ebp);
    a_.shr(x86::ecx, 2);
    a_.mov(x86::eax, x86::dword_ptr(x86::rbx, offsetof(KernelArgs, count)));
    a_.sub(x86::eax, x86::ecx);
    if (planted(PlantedFault::PaddingLaneAsks)) a_.inc(x86::eax);
    if (!state_.isa.wide) {
        a_.vmovd(x86::xmm15, x86::eax);
        a_.vpbroadcastd(x86::ymm15, x86::xmm15);
        a_.vpcmpgtd(x86::ymm15, x86::ymm15, state_.pool.iota());
        a_.vmovaps(x86::ptr(x86::r13, kValidVector), x86::ymm15);
    }
    // bzhi saturates its count at 255 only.
    a_.mov(x86::ecx, state_.isa.lanes);
    a_.cmp(x86::eax, x86::ecx);
    a_.cmovg(x86::eax, x86::ecx);
    a_.mov(x86::edx, -1);
    a_.bzhi(x86::edx, x86::edx, x86::eax);
    a_.mov(x86::dword_ptr(x86::r13, kValidBits), x86::edx);
}

// AVX2 has no broadcast inside an instruction, so frame slots become rows once a call.
void FunctionFrame::broadcast_frame() {
    for (size_t slot = 0; slot < state_.frame_row.size(); ++slot) {
        int32_t index = state_.frame_row[slot];
        if (index < 0) continue;
        a_.vbroadcastss(x86::ymm15, x86::ptr(x86::r14, 4 * static_cast<int32_t>(slot)));
        a_.vmovaps(x86::ptr(x86::r13, kFrameRows + 32 * index), x86::ymm15);
    }
}

}  // namespace kinora::jit::x64
