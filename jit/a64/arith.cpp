// jit/a64/arith.cpp: float and integer arithmetic, conversions, leaves.
#include "jit/a64/emit_p.h"

namespace kinora::jit::a64 {

namespace {

constexpr uint32_t kTwoTo31 = 0x4f000000u;  // as a float
constexpr uint32_t kNoInteger = 0x80000000u;

}  // namespace

void Emit::op_Add() {
    binary([&](Vec to, Vec a, Vec b) { a_.fadd(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_Sub() {
    binary([&](Vec to, Vec a, Vec b) { a_.fsub(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_Mul() {
    binary([&](Vec to, Vec a, Vec b) { a_.fmul(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_Div() {
    binary([&](Vec to, Vec a, Vec b) { a_.fdiv(to.s4(), a.s4(), b.s4()); });
}

// fmin orders zeros and spreads NaNs; ours is a comparison and a choice: a where it holds, else b.
void Emit::min_max(bool max) {
    binary([&](Vec to, Vec a, Vec b) {
        bool meets = to.id() == a.id() || to.id() == b.id();
        Vec choice = meets ? scratch(0) : to;
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
void Emit::op_Min() {
    min_max(false);
}
void Emit::op_Max() {
    min_max(true);
}

void Emit::op_Neg() {
    unary([&](Vec to, Vec a) { a_.fneg(to.s4(), a.s4()); });
}
void Emit::op_Abs() {
    unary([&](Vec to, Vec a) { a_.fabs(to.s4(), a.s4()); });
}
void Emit::op_Sqrt() {
    unary([&](Vec to, Vec a) { a_.fsqrt(to.s4(), a.s4()); });
}
void Emit::op_Floor() {
    unary([&](Vec to, Vec a) { a_.frintm(to.s4(), a.s4()); });
}
void Emit::op_Ceil() {
    unary([&](Vec to, Vec a) {
        planted(PlantedFault::WrongRounding) ? a_.frintm(to.s4(), a.s4())
                                             : a_.frintp(to.s4(), a.s4());
    });
}
void Emit::op_Trunc() {
    unary([&](Vec to, Vec a) { a_.frintz(to.s4(), a.s4()); });
}
void Emit::op_Round() {
    unary([&](Vec to, Vec a) { a_.frintn(to.s4(), a.s4()); });
}

void Emit::op_IAdd() {
    binary([&](Vec to, Vec a, Vec b) { a_.add(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_ISub() {
    binary([&](Vec to, Vec a, Vec b) { a_.sub(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_IMul() {
    binary([&](Vec to, Vec a, Vec b) { a_.mul(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_IAnd() {
    binary([&](Vec to, Vec a, Vec b) { a_.and_(to.b16(), a.b16(), b.b16()); });
}
void Emit::op_IOr() {
    binary([&](Vec to, Vec a, Vec b) { a_.orr(to.b16(), a.b16(), b.b16()); });
}
void Emit::op_IXor() {
    binary([&](Vec to, Vec a, Vec b) { a_.eor(to.b16(), a.b16(), b.b16()); });
}
void Emit::op_IMin() {
    binary([&](Vec to, Vec a, Vec b) { a_.smin(to.s4(), a.s4(), b.s4()); });
}
void Emit::op_IMax() {
    binary([&](Vec to, Vec a, Vec b) { a_.smax(to.s4(), a.s4(), b.s4()); });
}

// Right shifts encode 1..32 only.
void Emit::op_IShl() {
    unary([&](Vec to, Vec a) { a_.shl(to.s4(), a.s4(), now().imm); });
}
void Emit::op_IShr() {
    unary([&](Vec to, Vec a) {
        if (now().imm == 0) return move(to, a);
        a_.ushr(to.s4(), a.s4(), now().imm);
    });
}
void Emit::op_ISar() {
    unary([&](Vec to, Vec a) {
        if (now().imm == 0) return move(to, a);
        planted(PlantedFault::WrongShift) ? a_.ushr(to.s4(), a.s4(), now().imm)
                                          : a_.sshr(to.s4(), a.s4(), now().imm);
    });
}

// fcvtzs saturates and makes NaN 0: what is not below 2^31 is replaced (below -2^31 it is right).
void Emit::op_FToI() {
    unary([&](Vec to, Vec a) {
        Vec in_range = scratch(0), whole = scratch(2);
        if (planted(PlantedFault::ConversionSaturates)) return void(a_.fcvtzs(to.s4(), a.s4()));
        constant(in_range, kTwoTo31);
        a_.fcmgt(in_range.s4(), in_range.s4(), a.s4());
        a_.fcvtzs(whole.s4(), a.s4());
        Vec otherwise = scratch(1);  // a is not needed any more
        constant(otherwise, kNoInteger);
        a_.bsl(in_range.b16(), whole.b16(), otherwise.b16());
        move(to, in_range);
    });
}
void Emit::op_IToF() {
    unary([&](Vec to, Vec a) { a_.scvtf(to.s4(), a.s4()); });
}
void Emit::op_BitsFI() {
    Vec to = target();
    load(to, now().a);
    finish(to);
}
void Emit::op_BitsIF() {
    op_BitsFI();
}

// fmla adds to its destination, so the sum grows where the addend lies; beside the target if that
// holds a factor.
void Emit::op_Fma() {
    bool negative[3] = {};
    Value v[3] = {now().a, now().b, now().c};
    for (int k = 0; k < 3; ++k)
        if (plan_.values[v[k]].fused) {
            negative[k] = true;
            v[k] = inst(v[k]).a;
        }
    if (planted(PlantedFault::FmaNegationLost)) negative[2] = false;
    if (planted(PlantedFault::ProductNegationLost)) negative[0] = negative[1];
    auto [a, b, c] = v;
    Vec to = target();
    bool in_place = lies_in(to, c) && !negative[2];
    bool meets = lies_in(to, a) || lies_in(to, b);
    Vec sum = meets && !in_place ? scratch(0) : to;
    if (negative[2])
        a_.fneg(sum.s4(), reg(c, 0).s4());
    else
        load(sum, c);
    Vec left = reg(a, 1), right = reg(b, 2);
    if (negative[0] != negative[1])
        a_.fmls(sum.s4(), left.s4(), right.s4());
    else
        a_.fmla(sum.s4(), left.s4(), right.s4());
    move(to, sum);
    finish(to);
}

// Constants, frame values and inputs are loaded where they are used; those that were given a
// register, where their range begins.
void Emit::op_ConstF() {}
void Emit::op_ConstI() {}
void Emit::op_ConstM() {}
void Emit::op_Param() {}
void Emit::op_Input() {}
void Emit::op_FrameLoad() {}
void Emit::op_Merge() {}
void Emit::op_LoopOut() {}
// The derivatives pass leaves none.
void Emit::op_Du() {}
void Emit::op_Dv() {}
void Emit::op_WithSlope() {}

}  // namespace kinora::jit::a64
