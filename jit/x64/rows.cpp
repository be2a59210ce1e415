// jit/x64/rows.cpp: rows of lanes in memory that is shared with C++, and the leaves read from
// there.
#include "jit/x64/rows_p.h"

namespace kinora::jit::x64 {

void Rows::finish(const x86::Vec& lanes) {
    if (operands_.gives_mask()) {
        a_.vpmovd2m(operands_.mask_target(), lanes);
        return operands_.finish_mask(operands_.mask_target());
    }
    x86::Vec to = operands_.target();
    if (to.id() != lanes.id()) a_.emit(Id::kIdVmovaps, to, lanes);
    operands_.finish(to);
}

void Rows::load_result(const x86::Mem& from) {
    x86::Vec to = target();
    a_.emit(Id::kIdVmovups, to, from);
    finish(to);
}

x86::Vec Rows::lanes_of(Value v) {
    if (!operands_.is_mask(v)) return operands_.reg(v, 0);
    x86::Vec lanes = operands_.scratch(0);
    a_.vpmovm2d(lanes, operands_.mask_reg(v, 7));
    return lanes;
}

void Rows::store(const x86::Mem& to, Value v) {
    a_.emit(Id::kIdVmovaps, to, lanes_of(v));
}

void Rows::op_Param() {
    if (!operands_.gives_mask()) return;
    x86::KReg to = operands_.mask_target();
    a_.kmovw(to, operands_.row(cursor_.code().layout.params + kRow * cursor_->imm));
    operands_.finish_mask(to);
}

void Rows::op_Input() {
    if (!operands_.gives_mask()) return;
    x86::Gp pointer = operands_.next_pointer();
    a_.mov(pointer, x86::ptr(x86::r12, 8 * cursor_->imm));
    load_result(x86::ptr(pointer, x86::rbp));
}

void Rows::op_FrameLoad() {
    if (!operands_.gives_mask()) return;
    x86::Vec lanes = operands_.scratch(0);
    a_.vbroadcastss(lanes, x86::ptr(x86::r14, 4 * cursor_->imm));
    finish(lanes);
}

}  // namespace kinora::jit::x64
