// jit/x64/assignments.cpp: values written at more than one point.
#include "jit/x64/assignments_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

void Assignments::copy(Value to, Value from) {
    int reg = cursor_.interval(to).reg;
    bool memory_only = reg < 0;
    if (operands_.is_mask(to)) {
        if (memory_only)
            operands_.store_mask_slot(to, operands_.mask_reg(from, 7));
        else
            operands_.load_mask(Operands::k(reg), from);
    } else if (memory_only) {
        operands_.store_slot(to, operands_.reg(from, 0));
    } else {
        operands_.load(operands_.vec(reg), from);
    }
}

void Assignments::merge(Value to, Value from, Value mask) {
    if (!operands_.is_mask(to)) return merge_vector(to, from, mask);
    int reg = cursor_.interval(to).reg;
    x86::KReg k = reg < 0 ? x86::k7 : Operands::k(reg);
    blends_.blend_mask(k, to, from, mask);
    if (reg < 0) operands_.store_mask_slot(to, k);
}

void Assignments::merge_vector(Value to, Value from, Value mask) {
    if (int reg = cursor_.interval(to).reg; reg >= 0) {
        x86::Vec vec = operands_.vec(reg);
        return blends_.blend(vec, vec, from, mask);
    }
    x86::Vec merged = operands_.scratch(isa_.wide ? 1 : 0);
    if (isa_.wide) {
        // A store under a mask is not forwarded to the load that follows: store whole.
        x86::Vec next = operands_.reg(from, 0);
        operands_.load_memory(merged, operands_.slot(to));
        a_.k(operands_.mask_reg(mask, 7));
        a_.emit(Id::kIdVmovaps, merged, next);
    } else {
        operands_.load_memory(merged, operands_.slot(to));
        blends_.blend(merged, merged, from, mask);
    }
    operands_.store_slot(to, merged);
}

void Assignments::keep_old(int row, Value variable) {
    if (operands_.is_mask(variable))
        a_.kmovw(operands_.swap_row(row), operands_.mask_reg(variable, 7));
    else
        a_.emit(Id::kIdVmovaps, operands_.swap_row(row), operands_.reg(variable, 0));
    cursor_.keep_old(row, variable);
}

void Assignments::fill_slot(Value v) {
    const LiveInterval& interval = cursor_.interval(v);
    if (interval.reg < 0 || interval.slot < 0) return;
    if (operands_.is_mask(v))
        operands_.store_mask_slot(v, Operands::k(interval.reg));
    else
        operands_.store_slot(v, operands_.vec(interval.reg));
}

void Assignments::enter_loop(Value loop) {
    Value mask = cursor_->a;
    if (!cursor_.plan(loop).masked) return masks_.set_if_any(mask);
    // Padding lanes never loop: what services left in them may be anything.
    if (isa_.wide) {
        x86::KReg to = operands_.mask_target();
        x86::KReg entering = operands_.mask_reg(mask, 7);
        a_.kmovw(x86::k0, x86::ptr(x86::r13, kValidBits));
        a_.kandw(to, entering, x86::k0);
        operands_.finish_mask(to);
        a_.kortestw(to, to);
    } else {
        x86::Vec to = operands_.target();
        a_.vandps(to, operands_.reg(mask, 1), x86::ptr(x86::r13, kValidVector));
        operands_.finish(to);
        a_.vmovmskps(x86::eax, to);
        a_.test(x86::eax, x86::eax);
    }
}

void Assignments::update_loop_mask(Value loop, Value next_mask) {
    if (!cursor_.plan(loop).masked) return masks_.set_if_any(next_mask);
    int reg = cursor_.interval(loop).reg;
    Value kept = planted(PlantedFault::LoopMaskNotKept) ? next_mask : loop;
    if (isa_.wide) {
        x86::KReg to = reg < 0 ? x86::k7 : Operands::k(reg);
        a_.kandw(to, operands_.mask_reg(kept, 7), operands_.mask_reg(next_mask, 0));
        if (reg < 0) operands_.store_mask_slot(loop, to);
        a_.kortestw(to, to);
    } else {
        x86::Vec to = reg < 0 ? operands_.scratch(0) : operands_.vec(reg);
        x86::Vec old = operands_.reg(kept, 1);
        a_.emit(Id::kIdVandps, to, old, operands_.operand(next_mask));
        if (reg < 0) operands_.store_slot(loop, to);
        a_.vmovmskps(x86::eax, to);
        a_.test(x86::eax, x86::eax);
    }
}

}  // namespace kinora::jit::x64
