// jit/x64/arrays.cpp: a function's arrays: [element][lanes] in its frame.
#include "jit/x64/arrays_p.h"

#include <algorithm>

namespace kinora::jit::x64 {

void Arrays::zero() {
    const FrameLayout& layout = cursor_.code().layout;
    if (layout.cleared.empty()) return;
    x86::Vec zero = operands_.scratch(0);
    a_.vxorps(Operands::xmm(zero), Operands::xmm(zero), Operands::xmm(zero));
    for (const FrameLayout::Range& range : layout.cleared) {
        Label again = a_.newLabel();
        a_.lea(x86::rax, operands_.row(range.begin));
        a_.mov(x86::ecx, (range.end - range.begin) / kRow);
        a_.bind(again);
        a_.emit(Id::kIdVmovaps, x86::ptr(x86::rax), zero);
        if (!isa_.wide) a_.emit(Id::kIdVmovaps, x86::ptr(x86::rax, 32), zero);
        a_.add(x86::rax, kRow);
        a_.dec(x86::ecx);
        a_.jnz(again);
    }
}

int32_t Arrays::length() const {
    return cursor_.code().function.arrays[static_cast<size_t>(cursor_->imm)].length;
}

int32_t Arrays::offset() const {
    return cursor_.code().layout.arrays[static_cast<size_t>(cursor_->imm)];
}

// The row of an element whose index agrees in all lanes.
x86::Mem Arrays::element(Value index) {
    const Inst& constant = cursor_.inst(index);
    if (constant.op == Op::ConstI)
        return operands_.row(offset() + 4 * isa_.lanes * std::clamp(constant.imm, 0, length() - 1));
    indices_.clamped_lane_to(x86::eax, index, length());
    a_.shl(x86::rax, isa_.wide ? 6 : 5);
    return x86::ptr(x86::r15, x86::rax, 0, offset());
}

// AVX-512: word offsets of the lanes' elements, in scratch 1.
void Arrays::element_words(Value index) {
    x86::Vec words = operands_.scratch(1);
    indices_.clamp(words, index, length());
    a_.vpslld(words, words, 4);
    a_.vpaddd(words, words, pool_.iota());
}

void Arrays::op_ArrayLoad() {
    Value index = cursor_->a;
    if (cursor_.code().plan.agree[index]) return rows_.load_result(element(index));
    if (isa_.wide) {
        element_words(index);
        return gathers_.words(x86::r15, offset());
    }
    gathers_.by_lane(length(), [&](int lane) {
        a_.shl(x86::rax, 5);
        a_.mov(x86::ecx, x86::ptr(x86::r15, x86::rax, 0, offset() + 4 * lane));
    });
}

void Arrays::op_ArrayStore() {
    Value index = cursor_->a, value = cursor_->b, mask = cursor_->c;
    bool all = cursor_.inst(mask).op == Op::ConstM && cursor_.inst(mask).imm != 0;
    if (cursor_.code().plan.agree[index]) {
        x86::Mem to = element(index);
        operands_.restart_pointers(1);  // rax may be part of the address
        if (all) return rows_.store(to, value);
        store_under(to, value, mask);
    } else if (isa_.wide) {
        scatter(value, mask);
    } else {
        scatter_by_lane(value, mask);
    }
}

void Arrays::store_under(const x86::Mem& to, Value value, Value mask) {
    if (isa_.wide) {
        x86::Vec from = rows_.lanes_of(value);
        a_.k(operands_.mask_reg(mask, 7));
        a_.emit(Id::kIdVmovaps, to, from);
    } else {
        x86::Vec stored = operands_.scratch(0);
        a_.vmovaps(stored.as<x86::Ymm>(), to);
        blends_.blend(stored, stored, value, mask);
        a_.emit(Id::kIdVmovaps, to, stored);
    }
}

void Arrays::scatter(Value value, Value mask) {
    element_words(cursor_->a);
    x86::Vec from = rows_.lanes_of(value);
    operands_.load_mask(x86::k7, mask);  // the scatter clears it
    a_.k(x86::k7);
    a_.emit(Id::kIdVscatterdps, x86::ptr(x86::r15, operands_.scratch(1), 2, offset()), from);
}

void Arrays::scatter_by_lane(Value value, Value mask) {
    const FrameLayout& layout = cursor_.code().layout;
    x86::Vec clamped = operands_.scratch(0);
    indices_.clamp(clamped, cursor_->a, length());
    a_.emit(Id::kIdVmovaps, operands_.row(layout.lanes_a), clamped);
    a_.emit(Id::kIdVmovaps, operands_.row(layout.lanes_b), operands_.reg(value, 0));
    masks_.lane_bits(x86::edx, mask);
    for (int lane = 0; lane < isa_.lanes; ++lane) {
        Label skip = a_.newLabel();
        a_.test(x86::edx, 1 << lane);
        a_.jz(skip);
        a_.mov(x86::eax, operands_.row(layout.lanes_a + 4 * lane));
        a_.mov(x86::ecx, operands_.row(layout.lanes_b + 4 * lane));
        a_.shl(x86::rax, 5);
        a_.mov(x86::ptr(x86::r15, x86::rax, 0, offset() + 4 * lane), x86::ecx);
        a_.bind(skip);
    }
}

}  // namespace kinora::jit::x64
