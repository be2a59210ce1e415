// jit/x64/emit.cpp: a function's frame, entry and exit, and the walk over its instructions.
#include "jit/x64/emit_p.h"

#include "jit/codegen/module_code_p.h"
#include "runtime/base/check.h"

namespace kinora::jit::x64 {

namespace {

// A register that the caller keeps, and its number in DWARF (System V ABI, AMD64, figure 3.36).
struct Saved {
    x86::Gp gp;
    int dwarf;
};

}  // namespace

const Emit::Member Emit::kMembers[] = {
#define OP(name, operands, result, flags, meaning) &Emit::op_##name,
#include "jit/ir/ops.def"
#undef OP
};

Emit::Emit(ModuleState& state, size_t function_index)
    : FunctionCode(state.module, function_index, state.isa.rules()),
      state_(state),
      isa_(state.isa),
      a_(state.a) {}

void Emit::emit_function(bool listing) {
    if (is_kernel_)
        emit_kernel(listing);
    else
        emit_local(listing);
}

void Emit::emit_kernel(bool listing) {
    static constexpr Saved kSaved[] = {{x86::rbx, 3},  {x86::rbp, 6},  {x86::r12, 12},
                                       {x86::r13, 13}, {x86::r14, 14}, {x86::r15, 15}};
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
    a_.mov(x86::rbx, x86::rdi);
    a_.mov(x86::r12, x86::ptr(x86::rbx, offsetof(KernelArgs, in)));
    a_.mov(x86::r14, x86::ptr(x86::rbx, offsetof(KernelArgs, frame)));
    a_.mov(x86::r13, x86::ptr(x86::rbx, offsetof(KernelArgs, scratch)));
    a_.lea(x86::r15, x86::ptr(x86::r13, state_.globals_bytes));
    broadcast_frame();
    for (Value v : allocation_.function_hoists) load_constant(v);
    Label group = a_.newLabel();
    a_.xor_(x86::ebp, x86::ebp);
    a_.bind(group);
    if (state_.uses_valid) find_valid_lanes();
    emit_body(listing);
    a_.add(x86::rbp, 4 * isa_.lanes);
    a_.mov(x86::eax, x86::dword_ptr(x86::rbx, offsetof(KernelArgs, count)));
    a_.shl(x86::rax, 2);
    a_.cmp(x86::rbp, x86::rax);
    a_.jb(group);
    a_.vzeroupper();
    a_.add(x86::rsp, 8);
    unwind.frame_bytes(a_.offset(), frame);
    for (size_t k = std::size(kSaved); k-- > 0;) {
        a_.pop(kSaved[k].gp);
        unwind.frame_bytes(a_.offset(), frame -= 8);
        unwind.restored(kSaved[k].dwarf);
    }
    a_.ret();
}

// A function of the module: same registers, its own frame behind the caller's.
void Emit::emit_local(bool listing) {
    a_.bind(state_.entries[index_]);
    state_.unwind.begin_function(a_.offset());
    if (plan_.calls) move_stack(-8);
    emit_body(listing);
    if (plan_.calls) move_stack(8);
    a_.ret();
}

// Of a function that keeps nothing on the stack but its own frame, or has given it back.
void Emit::move_stack(int bytes) {
    if (bytes < 0)
        a_.sub(x86::rsp, -bytes);
    else
        a_.add(x86::rsp, bytes);
    state_.unwind.frame_bytes(a_.offset(), kUnwindX64.entry_bytes + (bytes < 0 ? -bytes : 0));
}

// Which lanes of this group hold points: those before `count`.
void Emit::find_valid_lanes() {
    a_.mov(x86::ecx, x86::ebp);
    a_.shr(x86::ecx, 2);
    a_.mov(x86::eax, x86::dword_ptr(x86::rbx, offsetof(KernelArgs, count)));
    a_.sub(x86::eax, x86::ecx);
    if (planted(PlantedFault::PaddingLaneAsks)) a_.inc(x86::eax);
    if (!isa_.wide) {
        a_.vmovd(x86::xmm15, x86::eax);
        a_.vpbroadcastd(x86::ymm15, x86::xmm15);
        a_.vpcmpgtd(x86::ymm15, x86::ymm15, state_.pool.iota());
        a_.vmovaps(x86::ptr(x86::r13, kValidVector), x86::ymm15);
    }
    // bzhi saturates its count at 255 only.
    a_.mov(x86::ecx, isa_.lanes);
    a_.cmp(x86::eax, x86::ecx);
    a_.cmovg(x86::eax, x86::ecx);
    a_.mov(x86::edx, -1);
    a_.bzhi(x86::edx, x86::edx, x86::eax);
    a_.mov(x86::dword_ptr(x86::r13, kValidBits), x86::edx);
}

// AVX2 has no broadcast inside an instruction, so frame slots become rows once a call.
void Emit::broadcast_frame() {
    for (size_t slot = 0; slot < state_.frame_row.size(); ++slot) {
        int32_t index = state_.frame_row[slot];
        if (index < 0) continue;
        a_.vbroadcastss(x86::ymm15, x86::ptr(x86::r14, 4 * static_cast<int32_t>(slot)));
        a_.vmovaps(x86::ptr(x86::r13, kFrameRows + 32 * index), x86::ymm15);
    }
}

void Emit::emit_body(bool listing) {
    zero_arrays();
    record_ = kNone;
    for (at_ = 0; at_ < f_.insts.size(); ++at_) {
        if (listing) a_.commentf("; %s", text_of(f_, at_, plan_.values[at_].fused).c_str());
        if (uint32_t where = now().where; where != 0)
            note_place(state_.places, a_.offset(), module_.locations[where]);
        for (Value v = allocation_.load_at[at_]; v != kNone; v = allocation_.load_next[v])
            if (place(v).reg >= 0 && place(v).in_reg(at_)) load_memory(vec(place(v).reg), home(v));
        if (plan_.values[at_].fused) continue;
        (this->*kMembers[static_cast<size_t>(inst(at_).op)])();
    }
}

}  // namespace kinora::jit::x64
