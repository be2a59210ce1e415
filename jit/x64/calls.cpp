// jit/x64/calls.cpp: calls of services (C++) and of the module's own functions, and their results.
#include "jit/x64/calls_p.h"

#include <cstddef>

#include "jit/ir/analysis.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

static_assert(sizeof(ServiceCall) <= kFrameRows - kServiceCall);

// Rows of arguments; masks travel as lanes to a service, as bits to our own functions.
void Calls::pass_arguments(int32_t to, bool to_service) {
    std::span<const Value> args = cursor_.args();
    for (size_t k = 0; k < args.size(); ++k) {
        x86::Mem row = operands_.row(to + kRow * static_cast<int32_t>(k));
        if (operands_.is_mask(cursor_.root(args[k])) && !to_service)
            a_.kmovw(row, operands_.mask_reg(args[k], 7));
        else
            rows_.store(row, args[k]);
    }
}

void Calls::op_Service() {
    Label skip = a_.newLabel();
    held_.drop();
    if (gives_handle(cursor_.code().module.services[static_cast<size_t>(cursor_->imm)]))
        clear_handle();
    masks_.lane_bits(x86::edx, cursor_->a);
    if (planted(PlantedFault::ServiceIgnoresMask)) a_.mov(x86::edx, -1);
    a_.and_(x86::edx, x86::dword_ptr(x86::r13, kValidBits));
    a_.jz(skip);
    fill_service_call();
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, services)));
    a_.lea(x86::rdi, x86::ptr(x86::r13, kServiceCall));
    a_.vzeroupper();
    a_.call(x86::ptr(x86::rax, 8 * cursor_->imm, 8));
    a_.bind(skip);
}

// Record sets are read by all lanes: where none asks, the handle is 0 all the same.
void Calls::clear_handle() {
    x86::Vec zero = operands_.scratch(0);
    a_.vxorps(Operands::xmm(zero), Operands::xmm(zero), Operands::xmm(zero));
    a_.emit(Id::kIdVmovaps, operands_.row(cursor_.code().layout.service_results), zero);
}

// The ServiceCall and its arguments, for the lanes in edx.
void Calls::fill_service_call() {
    const FrameLayout& layout = cursor_.code().layout;
    auto field = [](size_t offset) { return kServiceCall + static_cast<int32_t>(offset); };
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, mask))), x86::edx);
    pass_arguments(layout.service_args, true);
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, grid)));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, grid))), x86::rax);
    a_.lea(x86::rax, operands_.row(layout.service_args));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, args))), x86::rax);
    a_.lea(x86::rax, operands_.row(layout.service_results));
    a_.mov(x86::ptr(x86::r13, field(offsetof(ServiceCall, results))), x86::rax);
    a_.mov(x86::eax, x86::ebp);
    a_.shr(x86::eax, 2);
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, first))), x86::eax);
    a_.mov(x86::dword_ptr(x86::r13, field(offsetof(ServiceCall, lanes))), isa_.lanes);
}

void Calls::op_Call() {
    int32_t frame_bytes = cursor_.code().layout.bytes;
    Label skip = a_.newLabel();
    held_.drop();
    masks_.set_if_any(cursor_->a);
    a_.jz(skip);
    pass_arguments(frame_bytes, false);
    a_.add(x86::r15, frame_bytes);
    a_.call(entries_[static_cast<size_t>(cursor_->imm)]);
    a_.sub(x86::r15, frame_bytes);
    a_.bind(skip);
}

void Calls::op_Result() {
    const Inst& call = cursor_.inst(cursor_->a);
    const FrameLayout& layout = cursor_.code().layout;
    if (call.op == Op::Service)
        return rows_.load_result(operands_.row(layout.service_results + kRow * cursor_->imm));
    // A callee's frame begins with its parameters and results.
    x86::Mem from = operands_.row(layout.bytes + kRow * (call.arg_count + cursor_->imm));
    if (!operands_.gives_mask()) return rows_.load_result(from);
    a_.kmovw(operands_.mask_target(), from);
    operands_.finish_mask(operands_.mask_target());
}

void Calls::op_Return() {
    if (cursor_.code().is_kernel)
        return_outputs();
    else
        return_results();
}

void Calls::return_outputs() {
    std::span<const Value> values = cursor_.args();
    // No loop is open: its counters are free.
    a_.mov(x86::rdi, x86::ptr(x86::rbx, offsetof(KernelArgs, out)));
    for (size_t k = 0; k < values.size(); ++k) {
        Value v = values[k];
        a_.mov(x86::r8, x86::ptr(x86::rdi, 8 * static_cast<int32_t>(k)));
        x86::Mem to = x86::ptr(x86::r8, x86::rbp);
        bool loaded = k > 0 && cursor_.root(v) == cursor_.root(values[k - 1]) &&
                      !operands_.is_mask(v) && !cursor_.in_register(v);  // in scratch 0 still
        if (loaded)
            a_.emit(Id::kIdVmovaps, to, operands_.scratch(0));
        else
            rows_.store(to, v);
    }
}

void Calls::return_results() {
    std::span<const Value> values = cursor_.args();
    for (size_t k = 0; k < values.size(); ++k) {
        int32_t offset = cursor_.code().layout.results + kRow * static_cast<int32_t>(k);
        if (operands_.is_mask(cursor_.root(values[k])))
            a_.kmovw(operands_.row(offset), operands_.mask_reg(values[k], 7));
        else
            rows_.store(operands_.row(offset), values[k]);
    }
}

}  // namespace kinora::jit::x64
