// jit/a64/indices.cpp: indices into arrays, inputs and records.
#include "jit/a64/indices_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

using asmjit::arm::CondCode;
using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

void Indices::lane_to(const Gp& to, Value index) {
    index = cursor_.root(index);
    const FunctionCode& code = cursor_.code();
    Value loop = code.structure.loop_of[cursor_.at()];
    if (code.inst(index).op == Op::ConstI) {
        a_.mov(to, static_cast<uint32_t>(code.inst(index).imm));
    } else if (!code.plan.agree[index] && loop != kNone && cursor_.plan(loop).masked) {
        Vec lanes = operands_.reg(index, 0);
        a_.str(lanes, operands_.row(code.layout.lanes_a));
        masks_.lane_bits(to, loop);
        a_.rbit(to, to);
        a_.clz(to, to);
        operands_.add_offset(arm::x16, kStack, code.layout.lanes_a);
        a_.ldr(to, arm::ptr(arm::x16, to.x(), Shift(ShiftOp::kLSL, 2)));
    } else {
        a_.umov(to, operands_.reg(index, 1).s(0));
    }
}

void Indices::clamped_lane_to(const Gp& to, Value index, int32_t length) {
    lane_to(to, index);
    a_.cmp(to, 0);
    a_.csel(to, arm::wzr, to, CondCode::kLT);
    a_.mov(arm::w1, length - 1);
    a_.cmp(to, arm::w1);
    a_.csel(to, arm::w1, to, CondCode::kGT);
}

void Indices::clamp(const Vec& to, Value index, int32_t length) {
    Vec from = operands_.reg(index, 1), limit = Operands::scratch(2);
    if (planted(PlantedFault::ClampOffByOne) && cursor_->op == Op::ArrayLoad) ++length;
    operands_.zero(limit);
    a_.smax(to.s4(), from.s4(), limit.s4());
    operands_.constant(limit, static_cast<uint32_t>(length - 1));
    a_.smin(to.s4(), to.s4(), limit.s4());
}

}  // namespace kinora::jit::a64
