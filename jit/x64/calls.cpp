// jit/x64/calls.cpp: calls of services (C++) and of the module's own functions. No vector
// register lives through a call (values in need lie in memory); rbx rbp r12..r15 are kept.
#include "jit/ir/analysis.h"
#include "jit/x64/emit_p.h"

namespace kinora::jit::x64 {

static_assert(sizeof(ServiceCall) <= kFrameRows - kServiceCall);

// Rows of arguments; masks travel as lanes to a service, as bits to our own functions.
void Emit::pass_arguments(int32_t to, bool to_service) {
    std::span<const Value> args = f_.args_of(now());
    for (size_t k = 0; k < args.size(); ++k) {
        x86::Mem place = row(to + kRow * static_cast<int32_t>(k));
        if (is_mask(root(args[k])) && !to_service)
            a_.kmovw(place, mask_reg(args[k], 7));
        else
            store_typed(place, args[k]);
    }
}

void Emit::op_Service() {
    Label skip = a_.newLabel();
    record_ = kNone;
    if (gives_handle(module_.services[static_cast<size_t>(now().imm)])) {
        // Record sets are read by all lanes: where none asks, the handle is 0 all the same.
        a_.vxorps(xmm(scratch(0)), xmm(scratch(0)), xmm(scratch(0)));
        a_.emit(Id::kIdVmovaps, row(layout_.service_results), scratch(0));
    }
    mask_bits(x86::edx, now().a);
    if (planted(PlantedFault::ServiceIgnoresMask)) a_.mov(x86::edx, -1);
    a_.and_(x86::edx, x86::dword_ptr(x86::r13, kValidBits));
    a_.jz(skip);
    auto field = [](size_t offset) { return kServiceCall + static_cast<int32_t>(offset); };
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, mask))), x86::edx);
    pass_arguments(layout_.service_args, true);
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, grid)));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, grid))), x86::rax);
    a_.lea(x86::rax, row(layout_.service_args));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, args))), x86::rax);
    a_.lea(x86::rax, row(layout_.service_results));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, results))), x86::rax);
    a_.mov(x86::eax, x86::ebp);
    a_.shr(x86::eax, 2);
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, first))), x86::eax);
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, lanes))), isa_.lanes);
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, services)));
    a_.lea(x86::rdi, x86::ptr(x86::r13, kServiceCall));
    a_.vzeroupper();
    a_.call(x86::ptr(x86::rax, 8 * now().imm, 8));
    a_.bind(skip);
}

void Emit::op_Call() {
    Label skip = a_.newLabel();
    record_ = kNone;
    set_if_any(now().a);
    a_.jz(skip);
    pass_arguments(layout_.bytes, false);
    a_.add(x86::r15, layout_.bytes);
    a_.call(state_.entries[static_cast<size_t>(now().imm)]);
    a_.sub(x86::r15, layout_.bytes);
    a_.bind(skip);
}

void Emit::op_Result() {
    const Inst& call = inst(now().a);
    if (call.op == Op::Service) return load_result(row(layout_.service_results + kRow * now().imm));
    // A callee's frame begins with its parameters and results.
    x86::Mem from = row(layout_.bytes + kRow * (call.arg_count + now().imm));
    if (!is_mask(at_)) return load_result(from);
    a_.kmovw(mask_target(), from);
    finish_mask(mask_target());
}

void Emit::op_Return() {
    std::span<const Value> values = f_.args_of(now());
    // No loop is open: its counters are free.
    if (is_kernel_) a_.mov(x86::rdi, x86::ptr(x86::rbx, offsetof(KernelArgs, out)));
    for (size_t k = 0; k < values.size(); ++k) {
        Value v = values[k];
        if (is_kernel_) {
            a_.mov(x86::r8, x86::ptr(x86::rdi, 8 * static_cast<int32_t>(k)));
            x86::Mem to = x86::ptr(x86::r8, x86::rbp);
            bool loaded = k > 0 && root(v) == root(values[k - 1]) && !is_mask(v) &&
                          !in_register(v);  // it is in scratch(0) still
            if (loaded)
                a_.emit(Id::kIdVmovaps, to, scratch(0));
            else
                store_typed(to, v);
        } else if (is_mask(root(v))) {
            a_.kmovw(row(layout_.results + kRow * static_cast<int32_t>(k)), mask_reg(v, 7));
        } else {
            store_typed(row(layout_.results + kRow * static_cast<int32_t>(k)), v);
        }
    }
}

void Emit::op_Fault() {
    mask_bits(x86::eax, now().a);
    if (planted(PlantedFault::FaultIgnoresMask)) a_.mov(x86::eax, -1);
    Label none = a_.newLabel();
    a_.test(x86::dword_ptr(x86::r13, kValidBits), x86::eax);
    a_.jz(none);
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, fault)));
    a_.mov(x86::byte_ptr(x86::rax, now().imm), 1);
    a_.bind(none);
}

}  // namespace kinora::jit::x64
