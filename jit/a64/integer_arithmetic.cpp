// jit/a64/integer_arithmetic.cpp: arithmetic of integers, and conversions from and to floats.
#include "jit/a64/arithmetic_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

namespace {

constexpr uint32_t kTwoTo31 = 0x4f000000u;  // as a float
constexpr uint32_t kNoInteger = 0x80000000u;

}  // namespace

void IntegerArithmetic::op_IAdd() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.add(to.s4(), a.s4(), b.s4()); });
}
void IntegerArithmetic::op_ISub() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.sub(to.s4(), a.s4(), b.s4()); });
}
void IntegerArithmetic::op_IMul() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.mul(to.s4(), a.s4(), b.s4()); });
}
void IntegerArithmetic::op_IAnd() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.and_(to.b16(), a.b16(), b.b16()); });
}
void IntegerArithmetic::op_IOr() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.orr(to.b16(), a.b16(), b.b16()); });
}
void IntegerArithmetic::op_IXor() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.eor(to.b16(), a.b16(), b.b16()); });
}
void IntegerArithmetic::op_IMin() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.smin(to.s4(), a.s4(), b.s4()); });
}
void IntegerArithmetic::op_IMax() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.smax(to.s4(), a.s4(), b.s4()); });
}

// Right shifts encode 1..32 only.
void IntegerArithmetic::op_IShl() {
    operands_.unary([&](Vec to, Vec a) { a_.shl(to.s4(), a.s4(), cursor_->imm); });
}
void IntegerArithmetic::op_IShr() {
    operands_.unary([&](Vec to, Vec a) {
        if (cursor_->imm == 0) return operands_.move(to, a);
        a_.ushr(to.s4(), a.s4(), cursor_->imm);
    });
}

void IntegerArithmetic::op_ISar() {
    operands_.unary([&](Vec to, Vec a) {
        if (cursor_->imm == 0) return operands_.move(to, a);
        planted(PlantedFault::WrongShift) ? a_.ushr(to.s4(), a.s4(), cursor_->imm)
                                          : a_.sshr(to.s4(), a.s4(), cursor_->imm);
    });
}

// fcvtzs saturates and makes NaN 0: what is not below 2^31 is replaced (below -2^31 it is right).
void IntegerArithmetic::op_FToI() {
    operands_.unary([&](Vec to, Vec a) {
        Vec in_range = Operands::scratch(0), whole = Operands::scratch(2);
        if (planted(PlantedFault::ConversionSaturates)) return void(a_.fcvtzs(to.s4(), a.s4()));
        operands_.constant(in_range, kTwoTo31);
        a_.fcmgt(in_range.s4(), in_range.s4(), a.s4());
        a_.fcvtzs(whole.s4(), a.s4());
        Vec otherwise = Operands::scratch(1);  // a is not needed any more
        operands_.constant(otherwise, kNoInteger);
        a_.bsl(in_range.b16(), whole.b16(), otherwise.b16());
        operands_.move(to, in_range);
    });
}

void IntegerArithmetic::op_IToF() {
    operands_.unary([&](Vec to, Vec a) { a_.scvtf(to.s4(), a.s4()); });
}
void IntegerArithmetic::op_BitsFI() {
    Vec to = operands_.target();
    operands_.load(to, cursor_->a);
    operands_.finish(to);
}

void IntegerArithmetic::op_BitsIF() {
    op_BitsFI();
}

}  // namespace kinora::jit::a64
