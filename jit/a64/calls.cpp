// jit/a64/calls.cpp: calls of services (C++) and of the module's own functions. No vector
// register lives through a call (values in need lie in memory); x19..x25 are kept.
#include <cstddef>

#include "jit/a64/emit_p.h"
#include "jit/ir/analysis.h"

namespace kinora::jit::a64 {

static_assert(sizeof(ServiceCall) <= kGlobalsBytes - kServiceCall);

// Rows of arguments; masks travel as lanes.
void Emit::pass_arguments(int32_t to) {
    std::span<const Value> args = f_.args_of(now());
    for (size_t k = 0; k < args.size(); ++k) {
        Vec value = reg(args[k], 0);
        a_.str(value, row(to + kRow * static_cast<int32_t>(k)));
    }
}

void Emit::op_Service() {
    Label skip = a_.newLabel();
    record_ = kNone;
    if (gives_handle(module_.services[static_cast<size_t>(now().imm)])) {
        // Record sets are read by all lanes: where none asks, the handle is 0 all the same.
        add_offset(arm::x0, kStack, layout_.service_results);
        a_.stp(arm::xzr, arm::xzr, arm::ptr(arm::x0));
    }
    mask_bits(arm::w0, now().a);
    a_.ldr(arm::w1, arm::ptr(kGlobals, kValidBits));
    if (planted(PlantedFault::ServiceIgnoresMask)) a_.mov(arm::w0, arm::w1);
    a_.and_(arm::w0, arm::w0, arm::w1);
    branch_if_zero(arm::w0, skip);
    auto field = [](size_t offset) {
        return arm::ptr(kGlobals, kServiceCall + static_cast<int32_t>(offset));
    };
    a_.str(arm::w0, field(offsetof(ServiceCall, mask)));
    pass_arguments(layout_.service_args);
    a_.ldr(arm::x0, arm::ptr(kArgs, offsetof(KernelArgs, grid)));
    a_.str(arm::x0, field(offsetof(ServiceCall, grid)));
    add_offset(arm::x0, kStack, layout_.service_args);
    a_.str(arm::x0, field(offsetof(ServiceCall, args)));
    add_offset(arm::x0, kStack, layout_.service_results);
    a_.str(arm::x0, field(offsetof(ServiceCall, results)));
    a_.lsr(arm::x0, kGroup, 2);
    a_.str(arm::w0, field(offsetof(ServiceCall, first)));
    a_.mov(arm::w0, kLanes);
    a_.str(arm::w0, field(offsetof(ServiceCall, lanes)));
    a_.ldr(arm::x16, arm::ptr(kArgs, offsetof(KernelArgs, services)));
    a_.ldr(arm::x16, at(arm::x16, int64_t{8} * now().imm, 8));
    a_.add(arm::x0, kGlobals, kServiceCall);
    a_.blr(arm::x16);
    a_.bind(skip);
}

void Emit::op_Call() {
    Label skip = a_.newLabel();
    record_ = kNone;
    find_any(reg(now().a, 1));
    branch_if_zero(kAny, skip);
    pass_arguments(layout_.bytes);
    add_offset(kStack, kStack, layout_.bytes);
    a_.bl(state_.entries[static_cast<size_t>(now().imm)]);
    add_offset(kStack, kStack, -layout_.bytes);
    a_.bind(skip);
}

void Emit::op_Result() {
    const Inst& call = inst(now().a);
    // A callee's frame begins with its parameters and results.
    int32_t from = call.op == Op::Service ? layout_.service_results + kRow * now().imm
                                          : layout_.bytes + kRow * (call.arg_count + now().imm);
    a_.ldr(target(), row(from));
    finish(target());
}

void Emit::op_Return() {
    std::span<const Value> values = f_.args_of(now());
    if (is_kernel_) a_.ldr(arm::x0, arm::ptr(kArgs, offsetof(KernelArgs, out)));
    for (size_t k = 0; k < values.size(); ++k) {
        Vec value = reg(values[k], 0);
        if (is_kernel_) {
            a_.ldr(arm::x1, at(arm::x0, static_cast<int64_t>(8 * k), 8));
            a_.str(value, arm::ptr(arm::x1, kGroup));
        } else {
            a_.str(value, row(layout_.results + kRow * static_cast<int32_t>(k)));
        }
    }
}

void Emit::op_Fault() {
    Label none = a_.newLabel();
    mask_bits(arm::w0, now().a);
    a_.ldr(arm::w1, arm::ptr(kGlobals, kValidBits));
    if (planted(PlantedFault::FaultIgnoresMask)) a_.mov(arm::w0, arm::w1);
    a_.and_(arm::w0, arm::w0, arm::w1);
    a_.cbz(arm::w0, none);
    report_fault(now().imm);
    a_.bind(none);
}

}  // namespace kinora::jit::a64
