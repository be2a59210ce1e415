// jit/a64/memory.cpp: gathers, lane by lane, and the arrays of a function.
#include <algorithm>

#include "jit/a64/emit_p.h"

namespace kinora::jit::a64 {

using asmjit::arm::CondCode;
using asmjit::arm::Shift;
using asmjit::arm::ShiftOp;

// An index that agrees in all lanes, clamped to 0..length-1. Changes w1.
void Emit::index_to(const Gp& to, Value index, int32_t length) {
    lane_to(to, index);
    a_.cmp(to, 0);
    a_.csel(to, arm::wzr, to, CondCode::kLT);
    a_.mov(arm::w1, length - 1);
    a_.cmp(to, arm::w1);
    a_.csel(to, arm::w1, to, CondCode::kGT);
}

void Emit::clamp_lanes(const Vec& to, Value index, int32_t length) {
    Vec from = reg(index, 1);
    if (planted(PlantedFault::ClampOffByOne) && now().op == Op::ArrayLoad) ++length;
    zero(scratch(2));
    a_.smax(to.s4(), from.s4(), scratch(2).s4());
    constant(scratch(2), static_cast<uint32_t>(length - 1));
    a_.smin(to.s4(), to.s4(), scratch(2).s4());
}

// The instruction's value from one word a lane; lane_address leaves the word's address in x0, given
// the lane's clamped index in x0.
template <class LaneAddress>
void Emit::gather_by_lane(int32_t length, LaneAddress&& lane_address) {
    clamp_lanes(scratch(0), now().a, length);
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        a_.umov(arm::w0, scratch(0).s(lane));
        lane_address(lane);
        a_.ld1(scratch(1).s(lane), arm::ptr(arm::x0));
    }
    move(target(), scratch(1));
    finish(target());
}

void Emit::op_FrameGather() {
    int64_t offset = int64_t{4} * now().imm;
    const Shift words(ShiftOp::kLSL, 2);
    if (plan_.agree[now().a]) {
        index_to(arm::w0, now().a, now().imm2);
        add_offset(arm::x1, kFrameBlock, offset);
        broadcast(target(), arm::ptr(arm::x1, arm::x0, words));
        return finish(target());
    }
    add_offset(arm::x1, kFrameBlock, offset);
    gather_by_lane(now().imm2, [&](uint32_t) { a_.add(arm::x0, arm::x1, arm::x0, words); });
}

void Emit::op_Lookup() {
    auto words = std::span(module_.table)
                     .subspan(static_cast<size_t>(now().imm), static_cast<size_t>(now().imm2) + 1);
    Vec index = reg(now().a, 0);
    add_offset(arm::x1, kPool, state_.pool.row(words));
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        a_.umov(arm::w0, index.s(lane));
        if (!planted(PlantedFault::LookupUnmasked)) a_.and_(arm::w0, arm::w0, now().imm2);
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 2));
        a_.ld1(scratch(1).s(lane), arm::ptr(arm::x0));
    }
    move(target(), scratch(1));
    finish(target());
}

void Emit::op_InputGather() {
    int64_t offset = int64_t{8} * now().imm;
    const Shift pointers(ShiftOp::kLSL, 3);
    if (plan_.agree[now().a]) {
        index_to(arm::w0, now().a, now().imm2);
        add_offset(arm::x1, kIn, offset);
        a_.ldr(arm::x1, arm::ptr(arm::x1, arm::x0, pointers));
        a_.ldr(target(), arm::ptr(arm::x1, kGroup));
        return finish(target());
    }
    add_offset(arm::x1, kIn, offset);
    a_.mov(arm::x2, kGroup);
    gather_by_lane(now().imm2, [&](uint32_t) {
        a_.ldr(arm::x0, arm::ptr(arm::x1, arm::x0, pointers));
        a_.add(arm::x0, arm::x0, arm::x2);
        a_.add(arm::x2, arm::x2, 4);
    });
}

// --- arrays: [element][lanes] in the function's frame ---

void Emit::zero_arrays() {
    if (f_.arrays.empty()) return;
    // They lie behind each other, so one fill does.
    int32_t bytes = layout_.bytes - layout_.arrays[0];
    Label again = a_.newLabel();
    zero(scratch(0));
    add_offset(arm::x0, kStack, layout_.arrays[0]);
    a_.mov(arm::w1, bytes / kRow);
    a_.bind(again);
    for (int32_t k = 0; k < kRow; k += 2 * kVector)
        a_.stp(scratch(0), scratch(0), arm::ptr(arm::x0, k));
    a_.add(arm::x0, arm::x0, kRow);
    a_.sub(arm::w1, arm::w1, 1);
    a_.cbnz(arm::w1, again);
}

// x3 = the vector of an element whose index agrees in all lanes.
void Emit::find_element(Value index) {
    if (inst(index).op == Op::ConstI) {
        int32_t element = std::clamp(inst(index).imm, 0, array_length() - 1);
        return add_offset(arm::x3, kStack, array_offset() + kVector * element);
    }
    index_to(arm::w0, index, array_length());
    add_offset(arm::x3, kStack, array_offset());
    a_.add(arm::x3, arm::x3, arm::x0, Shift(ShiftOp::kLSL, 4));
}

void Emit::op_ArrayLoad() {
    if (plan_.agree[now().a]) {
        find_element(now().a);
        a_.ldr(target(), arm::ptr(arm::x3));
        return finish(target());
    }
    add_offset(arm::x1, kStack, array_offset());
    gather_by_lane(array_length(), [&](uint32_t) {
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
        a_.add(arm::x1, arm::x1, 4);
    });
}

void Emit::op_ArrayStore() {
    Value value = now().b, mask = now().c;
    bool all = inst(mask).op == Op::ConstM && inst(mask).imm != 0;
    if (!plan_.agree[now().a]) return scatter_by_lane(value, mask);
    find_element(now().a);
    Vec stored = scratch(0);
    if (all) {
        stored = reg(value, 0);
    } else {
        a_.ldr(stored, arm::ptr(arm::x3));
        blend(stored, stored, value, mask);
    }
    a_.str(stored, arm::ptr(arm::x3));
}

void Emit::scatter_by_lane(Value value, Value mask) {
    clamp_lanes(scratch(0), now().a, array_length());
    Vec from = reg(value, 1), m = reg(mask, 2);
    add_offset(arm::x1, kStack, array_offset());
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        Label skip = a_.newLabel();
        a_.umov(arm::w2, m.s(lane));
        a_.cbz(arm::w2, skip);
        a_.umov(arm::w0, scratch(0).s(lane));
        a_.add(arm::x0, arm::x1, arm::x0, Shift(ShiftOp::kLSL, 4));
        a_.st1(from.s(lane), arm::ptr(arm::x0));
        a_.bind(skip);
        a_.add(arm::x1, arm::x1, 4);
    }
}

}  // namespace kinora::jit::a64
