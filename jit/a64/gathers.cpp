// jit/a64/gathers.cpp: reads by an index that differs between lanes, lane by lane.
#include "jit/a64/gathers_p.h"

#include <span>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

void Gathers::finish(const Vec& words) {
    operands_.move(operands_.target(), words);
    operands_.finish(operands_.target());
}

void Gathers::op_FrameGather() {
    int64_t offset = int64_t{4} * cursor_->imm;
    const Shift words(ShiftOp::kLSL, 2);
    if (cursor_.code().plan.agree[cursor_->a]) {
        indices_.clamped_lane_to(arm::w0, cursor_->a, cursor_->imm2);
        operands_.add_offset(arm::x1, kFrameBlock, offset);
        operands_.broadcast(operands_.target(), arm::ptr(arm::x1, arm::x0, words));
        return operands_.finish(operands_.target());
    }
    operands_.add_offset(arm::x1, kFrameBlock, offset);
    by_lane(cursor_->imm2, [&](uint32_t) { a_.add(arm::x0, arm::x1, arm::x0, words); });
}

void Gathers::op_InputGather() {
    int64_t offset = int64_t{8} * cursor_->imm;
    const Shift pointers(ShiftOp::kLSL, 3);
    if (cursor_.code().plan.agree[cursor_->a]) {
        indices_.clamped_lane_to(arm::w0, cursor_->a, cursor_->imm2);
        operands_.add_offset(arm::x1, kIn, offset);
        a_.ldr(arm::x1, arm::ptr(arm::x1, arm::x0, pointers));
        a_.ldr(operands_.target(), arm::ptr(arm::x1, kGroup));
        return operands_.finish(operands_.target());
    }
    operands_.add_offset(arm::x1, kIn, offset);
    a_.mov(arm::x2, kGroup);
    by_lane(cursor_->imm2, [&](uint32_t) {
        a_.ldr(arm::x0, arm::ptr(arm::x1, arm::x0, pointers));
        a_.add(arm::x0, arm::x0, arm::x2);
        a_.add(arm::x2, arm::x2, 4);
    });
}

void Gathers::op_Lookup() {
    auto words =
        std::span(cursor_.code().module.table)
            .subspan(static_cast<size_t>(cursor_->imm), static_cast<size_t>(cursor_->imm2) + 1);
    Vec index = operands_.reg(cursor_->a, 0), found = Operands::scratch(1);
    operands_.add_offset(arm::x1, kPool, pool_.row(words));
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        a_.umov(arm::w0, index.s(lane));
        if (!planted(PlantedFault::LookupUnmasked)) a_.and_(arm::w0, arm::w0, cursor_->imm2);
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 2));
        a_.ld1(found.s(lane), arm::ptr(arm::x0));
    }
    finish(found);
}

}  // namespace kinora::jit::a64
