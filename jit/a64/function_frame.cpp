// jit/a64/function_frame.cpp: entry and exit of a function, and the loop over groups of lanes.
#include "jit/a64/function_frame_p.h"

#include <cstddef>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

namespace {

// Bytes that a kernel keeps on the machine stack: x29, x30, x19..x25, then d8..d15.
constexpr int kSavedGp = 80, kSavedVectors = 64;

}  // namespace

int FunctionFrame::saved_bytes() const {
    return kSavedGp + (state_.saves_registers ? kSavedVectors : 0);
}

void FunctionFrame::save_registers() {
    const Gp sp = arm::sp;
    int32_t saved = saved_bytes();
    state_.unwind.begin_function(a_.offset());
    a_.stp(arm::x29, arm::x30, arm::ptr_pre(sp, -saved));
    state_.unwind.frame_bytes(a_.offset(), saved);
    state_.unwind.saved(29, saved);
    state_.unwind.saved(30, saved - 8);
    a_.mov(arm::x29, sp);
    a_.stp(arm::x19, arm::x20, arm::ptr(sp, 16));
    a_.stp(arm::x21, arm::x22, arm::ptr(sp, 32));
    a_.stp(arm::x23, arm::x24, arm::ptr(sp, 48));
    a_.str(arm::x25, arm::ptr(sp, 64));
    // The low halves of v8..v15 are the caller's.
    for (uint32_t k = 0; state_.saves_registers && k < 8; k += 2)
        a_.stp(arm::d(8 + k), arm::d(9 + k), arm::ptr(sp, kSavedGp + static_cast<int32_t>(8 * k)));
    note_saved();
}

// Where save_registers has put the caller's registers; 72 is DWARF's number of d8.
void FunctionFrame::note_saved() {
    int32_t bytes = saved_bytes();
    state_.unwind.frame_bytes(a_.offset(), bytes);
    for (int k = 0; k < 7; ++k) state_.unwind.saved(19 + k, bytes - 16 - 8 * k);
    for (int k = 0; state_.saves_registers && k < 8; ++k)
        state_.unwind.saved(72 + k, bytes - kSavedGp - 8 * k);
}

void FunctionFrame::restore_registers() {
    const Gp sp = arm::sp;
    for (uint32_t k = 0; state_.saves_registers && k < 8; k += 2)
        a_.ldp(arm::d(8 + k), arm::d(9 + k), arm::ptr(sp, kSavedGp + static_cast<int32_t>(8 * k)));
    a_.ldr(arm::x25, arm::ptr(sp, 64));
    a_.ldp(arm::x23, arm::x24, arm::ptr(sp, 48));
    a_.ldp(arm::x21, arm::x22, arm::ptr(sp, 32));
    a_.ldp(arm::x19, arm::x20, arm::ptr(sp, 16));
    a_.ldp(arm::x29, arm::x30, arm::ptr_post(sp, saved_bytes()));
    state_.unwind.begin_function(a_.offset());  // all is as it was
}

// Called from the entry behind the code, which has put the pool's address into x9.
void FunctionFrame::enter_kernel() {
    a_.bind(state_.entries[code_.index]);
    save_registers();
    a_.mov(kArgs, arm::x0);
    a_.mov(kPool, arm::x9);
    a_.ldr(kIn, arm::ptr(kArgs, offsetof(KernelArgs, in)));
    a_.ldr(kFrameBlock, arm::ptr(kArgs, offsetof(KernelArgs, frame)));
    a_.ldr(kGlobals, arm::ptr(kArgs, offsetof(KernelArgs, scratch)));
    a_.add(kStack, kGlobals, kGlobalsBytes);
    for (Value v : code_.allocation.function_hoists) operands_.load_register(v);
    group_ = a_.newLabel();
    done_ = a_.newLabel();
    a_.mov(kGroup, 0);
    a_.bind(group_);
    if (state_.uses_valid) find_valid_lanes();
}

void FunctionFrame::leave_kernel() {
    a_.add(kGroup, kGroup, kVector);
    a_.ldr(arm::w0, arm::ptr(kArgs, offsetof(KernelArgs, count)));
    a_.lsl(arm::x0, arm::x0, 2);
    a_.cmp(kGroup, arm::x0);
    a_.b_hs(done_);
    a_.b(group_);
    a_.bind(done_);
    restore_registers();
    a_.ret(arm::x30);
}

// A function of the module: same registers, its own frame behind the caller's in scratch. On the
// machine stack a call takes 16 bytes, so nothing needs probing.
void FunctionFrame::enter_local() {
    UnwindWriter& unwind = state_.unwind;
    a_.bind(state_.entries[code_.index]);
    unwind.begin_function(a_.offset());
    if (!code_.plan.calls) return;
    a_.stp(arm::x29, arm::x30, arm::ptr_pre(arm::sp, -16));
    unwind.frame_bytes(a_.offset(), 16);
    unwind.saved(29, 16);
    unwind.saved(30, 8);
}

void FunctionFrame::leave_local() {
    if (code_.plan.calls) a_.ldp(arm::x29, arm::x30, arm::ptr_post(arm::sp, 16));
    state_.unwind.begin_function(a_.offset());
    a_.ret(arm::x30);
}

// Which lanes of this group hold points: those before `count`.
void FunctionFrame::find_valid_lanes() {
    Vec count = Operands::scratch(0), lanes = Operands::scratch(1);
    a_.ldr(arm::w0, arm::ptr(kArgs, offsetof(KernelArgs, count)));
    a_.lsr(arm::x1, kGroup, 2);
    a_.sub(arm::w0, arm::w0, arm::w1);
    if (planted(PlantedFault::PaddingLaneAsks)) a_.add(arm::w0, arm::w0, 1);
    a_.ldr(lanes, arm::ptr(kPool, Pool::kIota));
    a_.dup(count.s4(), arm::w0);
    a_.cmgt(count.s4(), count.s4(), lanes.s4());
    a_.str(count, arm::ptr(kGlobals, kValidVector));
    a_.mov(arm::w1, kLanes);
    a_.cmp(arm::w0, arm::w1);
    a_.csel(arm::w0, arm::w1, arm::w0, asmjit::arm::CondCode::kGT);
    a_.mov(arm::w1, 1);
    a_.lsl(arm::w1, arm::w1, arm::w0);
    a_.sub(arm::w1, arm::w1, 1);
    a_.str(arm::w1, arm::ptr(kGlobals, kValidBits));
}

}  // namespace kinora::jit::a64
