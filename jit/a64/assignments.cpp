// jit/a64/assignments.cpp: values written at more than one point.
#include "jit/a64/assignments_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

void Assignments::copy(Value to, Value from) {
    if (int reg = cursor_.interval(to).reg; reg < 0)
        operands_.store_slot(to, operands_.reg(from, 0));
    else
        operands_.load(Operands::vec(reg), from);
}

void Assignments::merge(Value to, Value from, Value mask) {
    if (int reg = cursor_.interval(to).reg; reg >= 0) {
        Vec vec = Operands::vec(reg);
        return blends_.blend(vec, vec, from, mask);
    }
    Vec merged = Operands::scratch(0);
    a_.ldr(merged, operands_.row(operands_.slot(to)));
    blends_.blend(merged, merged, from, mask);
    operands_.store_slot(to, merged);
}

void Assignments::keep_old(int row, Value variable) {
    Vec old = operands_.reg(variable, 0);
    a_.str(old, operands_.swap_row(row));
    cursor_.keep_old(row, variable);
}

void Assignments::fill_slot(Value v) {
    if (int reg = cursor_.interval(v).reg; reg >= 0) operands_.store_slot(v, Operands::vec(reg));
}

void Assignments::enter_loop(Value loop) {
    if (!cursor_.plan(loop).masked) return masks_.find_any(operands_.reg(cursor_->a, 1));
    // Padding lanes never loop: what services left in them may be anything.
    Vec to = operands_.target();
    Vec entering = operands_.reg(cursor_->a, 1), valid = Operands::scratch(2);
    a_.ldr(valid, arm::ptr(kGlobals, kValidVector));
    a_.and_(to.b16(), entering.b16(), valid.b16());
    operands_.finish(to);
    masks_.find_any(to);
}

void Assignments::update_loop_mask(Value loop, Value next_mask) {
    if (!cursor_.plan(loop).masked) return masks_.find_any(operands_.reg(next_mask, 1));
    int reg = cursor_.interval(loop).reg;
    Vec to = reg < 0 ? Operands::scratch(0) : Operands::vec(reg);
    Value kept = planted(PlantedFault::LoopMaskNotKept) ? next_mask : loop;
    Vec old = operands_.reg(kept, 1), more = operands_.reg(next_mask, 2);
    a_.and_(to.b16(), old.b16(), more.b16());
    if (reg < 0) operands_.store_slot(loop, to);
    masks_.find_any(to);
}

}  // namespace kinora::jit::a64
