// jit/a64/emit.cpp: a function's frame, entry and exit, and the walk over its instructions.
#include <cstddef>

#include "jit/a64/emit_p.h"
#include "jit/codegen/module_code_p.h"

namespace kinora::jit::a64 {

namespace {

// AVX-512's freedoms are missing: masks are vectors, and no compare is true on NaN.
constexpr CodeRules kRules = {
    .plan = {false, false, false}, .limits = {.registers = {kVectorRegisters}}, .lanes = kLanes};

// An instruction of the IR becomes at most this many bytes, an argument of its list included; tests
// over every op hold it (a conditional branch must reach over a whole function or be made far).
constexpr size_t kMostBytes = 400;
constexpr size_t kBranchReach = 1u << 20;

// Bytes that emit_kernel keeps on the machine stack: x29, x30, x19..x25, then d8..d15.
constexpr int kSavedGp = 80, kSavedVectors = 64;

}  // namespace

const Emit::Member Emit::kMembers[] = {
#define OP(name, operands, result, flags, meaning) &Emit::op_##name,
#include "jit/ir/ops.def"
#undef OP
};

Emit::Emit(ModuleState& state, size_t function_index)
    : FunctionCode(state.module, function_index, kRules),
      state_(state),
      a_(state.a),
      far_branches_((f_.insts.size() + f_.args.size()) * kMostBytes > kBranchReach) {}

bool Emit::uses_saved_registers() const {
    for (const Place& p : allocation_.places)
        if (p.reg >= kFirstSavedRegister) return true;
    return false;
}

void Emit::emit_function(bool listing) {
    if (is_kernel_)
        emit_kernel(listing);
    else
        emit_local(listing);
}

// Called from the entry behind the code, which has put the pool's address into x9.
void Emit::emit_kernel(bool listing) {
    const Gp sp = arm::sp;
    int32_t saved = kSavedGp + (state_.saves_registers ? kSavedVectors : 0);
    a_.bind(state_.entries[index_]);
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
    note_saved(saved);

    a_.mov(kArgs, arm::x0);
    a_.mov(kPool, arm::x9);
    a_.ldr(kIn, arm::ptr(kArgs, offsetof(KernelArgs, in)));
    a_.ldr(kFrameBlock, arm::ptr(kArgs, offsetof(KernelArgs, frame)));
    a_.ldr(kGlobals, arm::ptr(kArgs, offsetof(KernelArgs, scratch)));
    a_.add(kStack, kGlobals, kGlobalsBytes);
    for (Value v : allocation_.function_hoists) load_home(vec(place(v).reg), v);
    Label group = a_.newLabel(), done = a_.newLabel();
    a_.mov(kGroup, 0);
    a_.bind(group);
    if (state_.uses_valid) find_valid_lanes();
    emit_body(listing);
    a_.add(kGroup, kGroup, kVector);
    a_.ldr(arm::w0, arm::ptr(kArgs, offsetof(KernelArgs, count)));
    a_.lsl(arm::x0, arm::x0, 2);
    a_.cmp(kGroup, arm::x0);
    a_.b_hs(done);
    a_.b(group);
    a_.bind(done);

    for (uint32_t k = 0; state_.saves_registers && k < 8; k += 2)
        a_.ldp(arm::d(8 + k), arm::d(9 + k), arm::ptr(sp, kSavedGp + static_cast<int32_t>(8 * k)));
    a_.ldr(arm::x25, arm::ptr(sp, 64));
    a_.ldp(arm::x23, arm::x24, arm::ptr(sp, 48));
    a_.ldp(arm::x21, arm::x22, arm::ptr(sp, 32));
    a_.ldp(arm::x19, arm::x20, arm::ptr(sp, 16));
    a_.ldp(arm::x29, arm::x30, arm::ptr_post(sp, saved));
    state_.unwind.begin_function(a_.offset());  // all is as it was
    a_.ret(arm::x30);
}

// Where emit_kernel has put the caller's registers; 72 is DWARF's number of d8.
void Emit::note_saved(int32_t bytes) {
    state_.unwind.frame_bytes(a_.offset(), bytes);
    for (int k = 0; k < 7; ++k) state_.unwind.saved(19 + k, bytes - 16 - 8 * k);
    for (int k = 0; state_.saves_registers && k < 8; ++k)
        state_.unwind.saved(72 + k, bytes - kSavedGp - 8 * k);
}

// A function of the module: same registers, its own frame behind the caller's in scratch. On the
// machine stack a call takes 16 bytes, so nothing needs probing.
void Emit::emit_local(bool listing) {
    a_.bind(state_.entries[index_]);
    UnwindWriter& unwind = state_.unwind;
    unwind.begin_function(a_.offset());
    if (plan_.calls) {
        a_.stp(arm::x29, arm::x30, arm::ptr_pre(arm::sp, -16));
        unwind.frame_bytes(a_.offset(), 16);
        unwind.saved(29, 16);
        unwind.saved(30, 8);
    }
    emit_body(listing);
    if (plan_.calls) a_.ldp(arm::x29, arm::x30, arm::ptr_post(arm::sp, 16));
    unwind.begin_function(a_.offset());
    a_.ret(arm::x30);
}

// Which lanes of this group hold points: those before `count`.
void Emit::find_valid_lanes() {
    a_.ldr(arm::w0, arm::ptr(kArgs, offsetof(KernelArgs, count)));
    a_.lsr(arm::x1, kGroup, 2);
    a_.sub(arm::w0, arm::w0, arm::w1);
    if (planted(PlantedFault::PaddingLaneAsks)) a_.add(arm::w0, arm::w0, 1);
    a_.ldr(scratch(1), arm::ptr(kPool, Pool::kIota));
    a_.dup(scratch(0).s4(), arm::w0);
    a_.cmgt(scratch(0).s4(), scratch(0).s4(), scratch(1).s4());
    a_.str(scratch(0), arm::ptr(kGlobals, kValidVector));
    a_.mov(arm::w1, kLanes);
    a_.cmp(arm::w0, arm::w1);
    a_.csel(arm::w0, arm::w1, arm::w0, asmjit::arm::CondCode::kGT);
    a_.mov(arm::w1, 1);
    a_.lsl(arm::w1, arm::w1, arm::w0);
    a_.sub(arm::w1, arm::w1, 1);
    a_.str(arm::w1, arm::ptr(kGlobals, kValidBits));
}

void Emit::emit_body(bool listing) {
    zero_arrays();
    record_ = kNone;
    for (at_ = 0; at_ < f_.insts.size(); ++at_) {
        if (listing) a_.commentf("; %s", text_of(f_, at_, plan_.values[at_].fused).c_str());
        if (uint32_t where = now().where; where != 0)
            note_place(state_.places, a_.offset(), module_.locations[where]);
        for (Value v = allocation_.load_at[at_]; v != kNone; v = allocation_.load_next[v])
            if (place(v).reg >= 0 && place(v).in_reg(at_)) load_home(vec(place(v).reg), v);
        if (plan_.values[at_].fused) continue;
        (this->*kMembers[static_cast<size_t>(inst(at_).op)])();
    }
}

}  // namespace kinora::jit::a64
