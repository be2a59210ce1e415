// jit/a64/calls.cpp: calls of services (C++) and of the module's own functions, and their results.
#include "jit/a64/calls_p.h"

#include <cstddef>

#include "jit/ir/analysis.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

static_assert(sizeof(ServiceCall) <= kGlobalsBytes - kServiceCall);

// Rows of arguments; masks travel as lanes.
void Calls::pass_arguments(int32_t to) {
    std::span<const Value> args = cursor_.args();
    for (size_t k = 0; k < args.size(); ++k) {
        Vec value = operands_.reg(args[k], 0);
        a_.str(value, operands_.row(to + kRow * static_cast<int32_t>(k)));
    }
}

void Calls::op_Service() {
    const FunctionCode& code = cursor_.code();
    Label skip = a_.newLabel();
    held_.drop();
    if (gives_handle(code.module.services[static_cast<size_t>(cursor_->imm)])) {
        // Record sets are read by all lanes: where none asks, the handle is 0 all the same.
        operands_.add_offset(arm::x0, kStack, code.layout.service_results);
        a_.stp(arm::xzr, arm::xzr, arm::ptr(arm::x0));
    }
    masks_.lane_bits(arm::w0, cursor_->a);
    a_.ldr(arm::w1, arm::ptr(kGlobals, kValidBits));
    if (planted(PlantedFault::ServiceIgnoresMask)) a_.mov(arm::w0, arm::w1);
    a_.and_(arm::w0, arm::w0, arm::w1);
    branches_.if_zero(arm::w0, skip);
    fill_service_call();
    a_.ldr(arm::x16, arm::ptr(kArgs, offsetof(KernelArgs, services)));
    a_.ldr(arm::x16, operands_.address(arm::x16, int64_t{8} * cursor_->imm, 8));
    a_.add(arm::x0, kGlobals, kServiceCall);
    a_.blr(arm::x16);
    a_.bind(skip);
}

// The ServiceCall and its arguments, for the lanes in w0.
void Calls::fill_service_call() {
    const FrameLayout& layout = cursor_.code().layout;
    auto field = [](size_t offset) {
        return arm::ptr(kGlobals, kServiceCall + static_cast<int32_t>(offset));
    };
    a_.str(arm::w0, field(offsetof(ServiceCall, mask)));
    pass_arguments(layout.service_args);
    a_.ldr(arm::x0, arm::ptr(kArgs, offsetof(KernelArgs, grid)));
    a_.str(arm::x0, field(offsetof(ServiceCall, grid)));
    operands_.add_offset(arm::x0, kStack, layout.service_args);
    a_.str(arm::x0, field(offsetof(ServiceCall, args)));
    operands_.add_offset(arm::x0, kStack, layout.service_results);
    a_.str(arm::x0, field(offsetof(ServiceCall, results)));
    a_.lsr(arm::x0, kGroup, 2);
    a_.str(arm::w0, field(offsetof(ServiceCall, first)));
    a_.mov(arm::w0, kLanes);
    a_.str(arm::w0, field(offsetof(ServiceCall, lanes)));
}

void Calls::op_Call() {
    int32_t frame_bytes = cursor_.code().layout.bytes;
    Label skip = a_.newLabel();
    held_.drop();
    masks_.find_any(operands_.reg(cursor_->a, 1));
    branches_.if_zero(kAny, skip);
    pass_arguments(frame_bytes);
    operands_.add_offset(kStack, kStack, frame_bytes);
    a_.bl(entries_[static_cast<size_t>(cursor_->imm)]);
    operands_.add_offset(kStack, kStack, -frame_bytes);
    a_.bind(skip);
}

void Calls::op_Result() {
    const Inst& call = cursor_.inst(cursor_->a);
    const FrameLayout& layout = cursor_.code().layout;
    // A callee's frame begins with its parameters and results.
    int32_t from = call.op == Op::Service ? layout.service_results + kRow * cursor_->imm
                                          : layout.bytes + kRow * (call.arg_count + cursor_->imm);
    a_.ldr(operands_.target(), operands_.row(from));
    operands_.finish(operands_.target());
}

void Calls::op_Return() {
    const FunctionCode& code = cursor_.code();
    std::span<const Value> values = cursor_.args();
    if (code.is_kernel) a_.ldr(arm::x0, arm::ptr(kArgs, offsetof(KernelArgs, out)));
    for (size_t k = 0; k < values.size(); ++k) {
        Vec value = operands_.reg(values[k], 0);
        if (code.is_kernel) {
            a_.ldr(arm::x1, operands_.address(arm::x0, static_cast<int64_t>(8 * k), 8));
            a_.str(value, arm::ptr(arm::x1, kGroup));
        } else {
            a_.str(value, operands_.row(code.layout.results + kRow * static_cast<int32_t>(k)));
        }
    }
}

}  // namespace kinora::jit::a64
