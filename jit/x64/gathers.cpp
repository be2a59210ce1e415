// jit/x64/gathers.cpp: reads by an index that differs between lanes.
#include "jit/x64/gathers_p.h"

namespace kinora::jit::x64 {

void Gathers::begin_lanes(int32_t length) {
    x86::Vec clamped = operands_.scratch(0);
    indices_.clamp(clamped, cursor_->a, length);
    a_.emit(Id::kIdVmovaps, operands_.row(cursor_.code().layout.lanes_a), clamped);
}

void Gathers::begin_lane(int lane) {
    a_.mov(x86::eax, operands_.row(cursor_.code().layout.lanes_a + 4 * lane));
}

void Gathers::end_lane(int lane) {
    a_.mov(operands_.row(cursor_.code().layout.lanes_b + 4 * lane), x86::ecx);
}

void Gathers::end_lanes() {
    rows_.load_result(operands_.row(cursor_.code().layout.lanes_b));
}

void Gathers::words(const x86::Gp& base, int32_t offset) {
    x86::Vec to = rows_.target();
    a_.vxorps(Operands::xmm(to), Operands::xmm(to), Operands::xmm(to));
    a_.kxnorw(x86::k7, x86::k7, x86::k7);
    a_.k(x86::k7);
    a_.emit(Id::kIdVgatherdps, to, x86::ptr(base, operands_.scratch(1), 2, offset));
    rows_.finish(to);
}

void Gathers::op_FrameGather() {
    int32_t offset = 4 * cursor_->imm, length = cursor_->imm2;
    if (cursor_.code().plan.agree[cursor_->a]) {
        indices_.clamped_lane_to(x86::eax, cursor_->a, length);
        x86::Vec to = rows_.target();
        a_.emit(Id::kIdVbroadcastss, to, x86::ptr(x86::r14, x86::rax, 2, offset));
        rows_.finish(to);
    } else if (isa_.wide) {
        indices_.clamp(operands_.scratch(1), cursor_->a, length);
        words(x86::r14, offset);
    } else {
        by_lane(length, [&](int) { a_.mov(x86::ecx, x86::ptr(x86::r14, x86::rax, 2, offset)); });
    }
}

void Gathers::op_InputGather() {
    int32_t offset = 8 * cursor_->imm, length = cursor_->imm2;
    if (cursor_.code().plan.agree[cursor_->a]) {
        indices_.clamped_lane_to(x86::eax, cursor_->a, length);
        a_.mov(x86::rax, x86::ptr(x86::r12, x86::rax, 3, offset));
        return rows_.load_result(x86::ptr(x86::rax, x86::rbp));
    }
    by_lane(length, [&](int lane) {
        a_.mov(x86::rax, x86::ptr(x86::r12, x86::rax, 3, offset));
        a_.mov(x86::ecx, x86::ptr(x86::rax, x86::rbp, 0, 4 * lane));
    });
}

// A permutation of constants that stand behind the code.
void Gathers::op_Lookup() {
    const FunctionCode& code = cursor_.code();
    auto words =
        std::span(code.module.table)
            .subspan(static_cast<size_t>(cursor_->imm), static_cast<size_t>(cursor_->imm2) + 1);
    x86::Mem first = pool_.row(words);
    x86::Vec index = operands_.reg(cursor_->a, 1), to = operands_.target();
    if (isa_.wide || words.size() == 8) {
        a_.emit(Id::kIdVpermps, to, index, first);
        return operands_.finish(to);
    }
    // AVX2 sees 8 words at once: bit 3 of the index, as a sign, chooses between two such rows.
    x86::Vec lower = operands_.scratch(0), sign = operands_.scratch(1);
    x86::Mem upper = operands_.row(code.layout.lanes_a);
    a_.emit(Id::kIdVpermps, lower, index, first.cloneAdjusted(32));
    a_.emit(Id::kIdVmovaps, upper, lower);
    a_.emit(Id::kIdVpermps, lower, index, first);
    a_.emit(Id::kIdVpslld, sign, index, asmjit::Imm(28));
    a_.emit(Id::kIdVblendvps, to, lower, upper, sign);
    operands_.finish(to);
}

}  // namespace kinora::jit::x64
