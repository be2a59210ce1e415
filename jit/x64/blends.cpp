// jit/x64/blends.cpp: one of two values in each lane, by a mask.
#include "jit/x64/blends_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

void Blends::blend(const x86::Vec& to, const x86::Vec& otherwise, Value then, Value mask) {
    if (isa_.wide) {
        x86::KReg k = operands_.mask_reg(mask, 7);
        Operand right = operands_.operand(then);
        a_.k(k);
        a_.emit(Id::kIdVblendmps, to, otherwise, right);
    } else {
        x86::Vec m = operands_.reg(mask, 1);
        a_.emit(Id::kIdVblendvps, to, otherwise, operands_.operand(then), m);
    }
}

// As otherwise ^ ((then ^ otherwise) & mask): two scratch registers do, wherever the three lie.
void Blends::blend_mask(const x86::KReg& to, Value otherwise, Value then, Value mask) {
    a_.kxorw(x86::k0, operands_.mask_reg(then, 0), operands_.mask_reg(otherwise, 7));
    a_.kandw(x86::k0, x86::k0, operands_.mask_reg(mask, 7));
    a_.kxorw(to, x86::k0, operands_.mask_reg(otherwise, 7));
}

void Blends::op_Select() {
    if (operands_.gives_mask()) {
        x86::KReg to = operands_.mask_target();
        blend_mask(to, cursor_->c, cursor_->b, cursor_->a);
        return operands_.finish_mask(to);
    }
    x86::Vec to = operands_.target();
    if (cursor_.plan(cursor_->b).fused)
        select_computed(to);
    else
        select(to);
    operands_.finish(to);
}

void Blends::select(const x86::Vec& to) {
    Value mask = cursor_->a, then = cursor_->b, otherwise = cursor_->c;
    const FunctionCode& code = cursor_.code();
    if (isa_.wide && code.is_zero(otherwise)) {
        x86::KReg k = operands_.mask_reg(mask, 7);
        Operand from = operands_.operand(then);
        bool word = from.isMem() && from.as<x86::Mem>().hasBroadcast();
        if (word) from.as<x86::Mem>().resetBroadcast();
        planted(PlantedFault::ZeroArmMixed) ? a_.k(k) : a_.k(k).z();
        a_.emit(word ? Id::kIdVbroadcastss : Id::kIdVmovaps, to, from);
    } else if (!isa_.wide && code.is_zero(otherwise)) {
        x86::Vec m = operands_.reg(mask, 1);
        a_.emit(Id::kIdVandps, to, m, operands_.operand(then));
    } else if (!isa_.wide && code.is_zero(then)) {
        x86::Vec m = operands_.reg(mask, 1);
        a_.emit(planted(PlantedFault::ZeroArmMixed) ? Id::kIdVandps : Id::kIdVandnps, to, m,
                operands_.operand(otherwise));
    } else {
        blend(to, operands_.reg(otherwise, 0), then, mask);
    }
}

// The arm is computed over the other one where the mask is set; beside it if that lives on.
void Blends::select_computed(const x86::Vec& to) {
    Value otherwise = cursor_->c;
    const Inst& arm = cursor_.inst(cursor_->b);
    if (operands_.lies_in(to, otherwise)) {
        x86::KReg k = operands_.mask_reg(cursor_->a, 7);
        floats_.compute_into(to, arm, &k);
    } else {
        x86::Vec computed = operands_.scratch(0);
        floats_.compute_into(computed, arm, nullptr);
        x86::Vec other = operands_.reg(otherwise, 1);
        a_.k(operands_.mask_reg(cursor_->a, 7));
        a_.emit(Id::kIdVblendmps, to, other, computed);
    }
}

}  // namespace kinora::jit::x64
