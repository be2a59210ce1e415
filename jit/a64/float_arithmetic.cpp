// jit/a64/float_arithmetic.cpp: arithmetic and rounding of floats.
#include "jit/a64/arithmetic_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

void FloatArithmetic::op_Add() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fadd(to.s4(), a.s4(), b.s4()); });
}
void FloatArithmetic::op_Sub() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fsub(to.s4(), a.s4(), b.s4()); });
}
void FloatArithmetic::op_Mul() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fmul(to.s4(), a.s4(), b.s4()); });
}
void FloatArithmetic::op_Div() {
    operands_.binary([&](Vec to, Vec a, Vec b) { a_.fdiv(to.s4(), a.s4(), b.s4()); });
}

// fmin orders zeros and spreads NaNs; ours is a comparison and a choice: a where it holds, else b.
void FloatArithmetic::min_max(bool max) {
    operands_.binary([&](Vec to, Vec a, Vec b) {
        bool meets = to.id() == a.id() || to.id() == b.id();
        Vec choice = meets ? Operands::scratch(0) : to;
        if (max)
            a_.fcmgt(choice.s4(), a.s4(), b.s4());
        else
            a_.fcmgt(choice.s4(), b.s4(), a.s4());
        if (to.id() == b.id() && !planted(PlantedFault::MinMaxMixed))
            a_.bit(to.b16(), a.b16(), choice.b16());
        else if (meets)
            a_.bif(to.b16(), b.b16(), choice.b16());
        else
            a_.bsl(to.b16(), a.b16(), b.b16());
    });
}

void FloatArithmetic::op_Min() {
    min_max(false);
}
void FloatArithmetic::op_Max() {
    min_max(true);
}

void FloatArithmetic::op_Neg() {
    operands_.unary([&](Vec to, Vec a) { a_.fneg(to.s4(), a.s4()); });
}
void FloatArithmetic::op_Abs() {
    operands_.unary([&](Vec to, Vec a) { a_.fabs(to.s4(), a.s4()); });
}
void FloatArithmetic::op_Sqrt() {
    operands_.unary([&](Vec to, Vec a) { a_.fsqrt(to.s4(), a.s4()); });
}
void FloatArithmetic::op_Floor() {
    operands_.unary([&](Vec to, Vec a) { a_.frintm(to.s4(), a.s4()); });
}
void FloatArithmetic::op_Ceil() {
    operands_.unary([&](Vec to, Vec a) {
        planted(PlantedFault::WrongRounding) ? a_.frintm(to.s4(), a.s4())
                                             : a_.frintp(to.s4(), a.s4());
    });
}

void FloatArithmetic::op_Trunc() {
    operands_.unary([&](Vec to, Vec a) { a_.frintz(to.s4(), a.s4()); });
}
void FloatArithmetic::op_Round() {
    operands_.unary([&](Vec to, Vec a) { a_.frintn(to.s4(), a.s4()); });
}
// fmla adds to its destination, so the sum grows where the addend lies; beside the target if that
// holds a factor.
void FloatArithmetic::op_Fma() {
    bool negative[3] = {};
    Value v[3] = {cursor_->a, cursor_->b, cursor_->c};
    for (int k = 0; k < 3; ++k)
        if (cursor_.plan(v[k]).fused) {
            negative[k] = true;
            v[k] = cursor_.inst(v[k]).a;
        }
    if (planted(PlantedFault::FmaNegationLost)) negative[2] = false;
    if (planted(PlantedFault::ProductNegationLost)) negative[0] = negative[1];
    auto [a, b, c] = v;
    Vec to = operands_.target();
    bool adds_to_c = operands_.lies_in(to, c) && !negative[2];
    bool meets = operands_.lies_in(to, a) || operands_.lies_in(to, b);
    Vec sum = meets && !adds_to_c ? Operands::scratch(0) : to;
    if (negative[2])
        a_.fneg(sum.s4(), operands_.reg(c, 0).s4());
    else
        operands_.load(sum, c);
    Vec left = operands_.reg(a, 1), right = operands_.reg(b, 2);
    if (negative[0] != negative[1])
        a_.fmls(sum.s4(), left.s4(), right.s4());
    else
        a_.fmla(sum.s4(), left.s4(), right.s4());
    operands_.move(to, sum);
    operands_.finish(to);
}

}  // namespace kinora::jit::a64
