// jit/x64/float_arithmetic.cpp: arithmetic and rounding of floats.
#include "jit/x64/arithmetic_p.h"

#include <utility>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

namespace {

constexpr uint32_t kSign = 0x80000000u;
constexpr uint32_t kMagnitude = 0x7fffffffu;

// Rounding modes of vroundps and vrndscaleps, without the precision exception.
constexpr int kNearest = 8, kDown = 9, kUp = 10, kTowardsZero = 11;

// vfmadd and its kin, named by which operands are multiplied: [negate product][negate addend].
struct FmaForm {
    InstId mul13_add2, mul12_add3, mul23_add1;  // 132, 213, 231
};
constexpr FmaForm kFma[2][2] = {
    {{Id::kIdVfmadd132ps, Id::kIdVfmadd213ps, Id::kIdVfmadd231ps},
     {Id::kIdVfmsub132ps, Id::kIdVfmsub213ps, Id::kIdVfmsub231ps}},
    {{Id::kIdVfnmadd132ps, Id::kIdVfnmadd213ps, Id::kIdVfnmadd231ps},
     {Id::kIdVfnmsub132ps, Id::kIdVfnmsub213ps, Id::kIdVfnmsub231ps}},
};

}  // namespace

void FloatArithmetic::op_Add() {
    plain_.binary(Id::kIdVaddps, true);
}
void FloatArithmetic::op_Sub() {
    plain_.binary(Id::kIdVsubps, planted(PlantedFault::SwappedOperands));
}
void FloatArithmetic::op_Mul() {
    plain_.binary(Id::kIdVmulps, true);
}
void FloatArithmetic::op_Div() {
    plain_.binary(Id::kIdVdivps, false);
}
// vminps is a < b ? a : b to the bit: the second operand if either is NaN or both are zeros.
void FloatArithmetic::op_Min() {
    plain_.binary(Id::kIdVminps, false);
}
void FloatArithmetic::op_Max() {
    plain_.binary(Id::kIdVmaxps, false);
}
void FloatArithmetic::op_Neg() {
    plain_.with_constant(Id::kIdVxorps, kSign);
}
void FloatArithmetic::op_Abs() {
    plain_.with_constant(Id::kIdVandps, kMagnitude);
}
void FloatArithmetic::op_Sqrt() {
    plain_.unary(Id::kIdVsqrtps);
}

void FloatArithmetic::round(int mode) {
    plain_.unary_imm(isa_.wide ? Id::kIdVrndscaleps : Id::kIdVroundps, mode);
}
void FloatArithmetic::op_Floor() {
    round(kDown);
}
void FloatArithmetic::op_Ceil() {
    round(planted(PlantedFault::WrongRounding) ? kDown : kUp);
}
void FloatArithmetic::op_Trunc() {
    round(kTowardsZero);
}
void FloatArithmetic::op_Round() {
    round(kNearest);
}

void FloatArithmetic::op_Fma() {
    x86::Vec to = operands_.target();
    fma_into(to, *cursor_, nullptr);
    operands_.finish(to);
}

void FloatArithmetic::negate_into(const x86::Vec& to, Value v, const x86::KReg* under) {
    x86::Vec from = operands_.reg(v, 1);
    if (under != nullptr) a_.k(*under);
    a_.emit(Id::kIdVxorps, to, from, operands_.constant(kSign));
}

// The destination is one of the operands: a dying one whose register we were given, else one that
// is loaded from memory anyway, else a copy of the addend. With `under` it must be the first.
void FloatArithmetic::fma_into(const x86::Vec& to, const Inst& fma, const x86::KReg* under) {
    bool negative[3] = {};
    Value v[3] = {fma.a, fma.b, fma.c};
    for (int k = 0; k < 3; ++k)
        if (cursor_.plan(v[k]).fused) {
            negative[k] = true;
            v[k] = cursor_.inst(v[k]).a;
        }
    if (planted(PlantedFault::FmaNegationLost)) negative[2] = false;
    auto [a, b, c] = v;
    const FmaForm& form = kFma[negative[0] != negative[1]][negative[2]];
    auto emit = [&](InstId id, const x86::Vec& second, const Operand& third) {
        if (under != nullptr) a_.k(*under);
        a_.emit(id, to, second, third);
    };
    Operands& o = operands_;
    if (o.lies_in(to, b) || (!cursor_.in_register(a) && cursor_.in_register(b))) std::swap(a, b);
    if (o.lies_in(to, a) && !o.lies_in(to, c)) {
        x86::Vec second = o.reg(cursor_.in_register(b) ? b : c, 1);
        if (cursor_.in_register(b))
            emit(planted(PlantedFault::FmaFormsMixed) ? form.mul13_add2 : form.mul12_add3, second,
                 o.operand(c));
        else
            emit(form.mul13_add2, second, o.operand(b));
    } else if (!o.lies_in(to, c) && cursor_.in_register(c) && !cursor_.in_register(b)) {
        // Not in its register: start from the factor that is in memory.
        o.load(to, b);
        emit(form.mul12_add3, o.reg(a, 1), o.operand(c));
    } else {
        x86::Vec factor = o.reg(a, 1);
        if (!o.lies_in(to, c)) o.load(to, c);
        emit(form.mul23_add1, factor, o.operand(b));
    }
}

void FloatArithmetic::compute_into(const x86::Vec& to, const Inst& inst, const x86::KReg* under) {
    if (inst.op == Op::Fma) return fma_into(to, inst, under);
    if (inst.op == Op::Neg) return negate_into(to, inst.a, under);
    InstId id = inst.op == Op::Add   ? Id::kIdVaddps
                : inst.op == Op::Sub ? Id::kIdVsubps
                                     : Id::kIdVmulps;
    plain_.binary_into(to, id, inst, inst.op != Op::Sub, under);
}

}  // namespace kinora::jit::x64
