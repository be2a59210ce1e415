// jit/a64/arrays.cpp: a function's arrays: [element][lanes] in its frame.
#include "jit/a64/arrays_p.h"

#include <algorithm>

namespace kinora::jit::a64 {

using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

void Arrays::zero() {
    const FrameLayout& layout = cursor_.code().layout;
    if (layout.cleared.empty()) return;
    Vec zero = Operands::scratch(0);
    operands_.zero(zero);
    for (const FrameLayout::Range& range : layout.cleared) {
        Label again = a_.newLabel();
        operands_.add_offset(arm::x0, kStack, range.begin);
        a_.mov(arm::w1, (range.end - range.begin) / kRow);
        a_.bind(again);
        for (int32_t k = 0; k < kRow; k += 2 * kVector) a_.stp(zero, zero, arm::ptr(arm::x0, k));
        a_.add(arm::x0, arm::x0, kRow);
        a_.sub(arm::w1, arm::w1, 1);
        a_.cbnz(arm::w1, again);
    }
}

int32_t Arrays::length() const {
    return cursor_.code().function.arrays[static_cast<size_t>(cursor_->imm)].length;
}

int32_t Arrays::offset() const {
    return cursor_.code().layout.arrays[static_cast<size_t>(cursor_->imm)];
}

// x3 = the vector of an element whose index agrees in all lanes.
void Arrays::find_element(Value index) {
    if (const Inst& constant = cursor_.inst(index); constant.op == Op::ConstI) {
        int32_t element = std::clamp(constant.imm, 0, length() - 1);
        return operands_.add_offset(arm::x3, kStack, offset() + kVector * element);
    }
    indices_.clamped_lane_to(arm::w0, index, length());
    operands_.add_offset(arm::x3, kStack, offset());
    a_.add(arm::x3, arm::x3, arm::x0, Shift(ShiftOp::kLSL, 4));
}

void Arrays::op_ArrayLoad() {
    if (cursor_.code().plan.agree[cursor_->a]) {
        find_element(cursor_->a);
        a_.ldr(operands_.target(), arm::ptr(arm::x3));
        return operands_.finish(operands_.target());
    }
    operands_.add_offset(arm::x1, kStack, offset());
    gathers_.by_lane(length(), [&](uint32_t) {
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
        a_.add(arm::x1, arm::x1, 4);
    });
}

void Arrays::op_ArrayStore() {
    Value value = cursor_->b, mask = cursor_->c;
    bool all = cursor_.inst(mask).op == Op::ConstM && cursor_.inst(mask).imm != 0;
    if (!cursor_.code().plan.agree[cursor_->a]) return scatter_by_lane(value, mask);
    find_element(cursor_->a);
    Vec stored = Operands::scratch(0);
    if (all) {
        stored = operands_.reg(value, 0);
    } else {
        a_.ldr(stored, arm::ptr(arm::x3));
        blends_.blend(stored, stored, value, mask);
    }
    a_.str(stored, arm::ptr(arm::x3));
}

void Arrays::scatter_by_lane(Value value, Value mask) {
    Vec clamped = Operands::scratch(0);
    indices_.clamp(clamped, cursor_->a, length());
    Vec from = operands_.reg(value, 1), m = operands_.reg(mask, 2);
    operands_.add_offset(arm::x1, kStack, offset());
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        Label skip = a_.newLabel();
        a_.umov(arm::w2, m.s(lane));
        a_.cbz(arm::w2, skip);
        a_.umov(arm::w0, clamped.s(lane));
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
        a_.st1(from.s(lane), arm::ptr(arm::x0));
        a_.bind(skip);
        a_.add(arm::x1, arm::x1, 4);
    }
}

}  // namespace kinora::jit::a64
