// jit/x64/plain_ops.cpp: IR instructions that are one machine instruction.
#include "jit/x64/arithmetic_p.h"

#include <utility>

namespace kinora::jit::x64 {

void PlainOps::binary(InstId id, bool commutative) {
    x86::Vec to = operands_.target();
    binary_into(to, id, *cursor_, commutative, nullptr);
    operands_.finish(to);
}

void PlainOps::binary_into(const x86::Vec& to, InstId id, const Inst& inst, bool commutative,
                           const x86::KReg* under) {
    Value a = inst.a, b = inst.b;
    if (commutative && !cursor_.in_register(a) && cursor_.in_register(b)) std::swap(a, b);
    x86::Vec left = operands_.reg(a, 1);
    Operand right = operands_.operand(b);
    if (under != nullptr) a_.k(*under);
    a_.emit(id, to, left, right);
}

void PlainOps::unary(InstId id) {
    x86::Vec to = operands_.target();
    a_.emit(id, to, operands_.operand(cursor_->a));
    operands_.finish(to);
}

void PlainOps::unary_imm(InstId id, int imm) {
    x86::Vec to = operands_.target();
    a_.emit(id, to, operands_.operand(cursor_->a), asmjit::Imm(imm));
    operands_.finish(to);
}

void PlainOps::with_constant(InstId id, uint32_t bits) {
    x86::Vec left = operands_.reg(cursor_->a, 1);
    x86::Vec to = operands_.target();
    a_.emit(id, to, left, operands_.constant(bits));
    operands_.finish(to);
}

void PlainOps::shift(InstId id) {
    x86::Vec left = operands_.reg(cursor_->a, 1);
    x86::Vec to = operands_.target();
    a_.emit(id, to, left, asmjit::Imm(cursor_->imm));
    operands_.finish(to);
}

}  // namespace kinora::jit::x64
