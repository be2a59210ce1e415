// jit/x64/arith.cpp: float and integer arithmetic, conversions, leaves.
#include <utility>

#include "jit/x64/emit_p.h"

namespace kinora::jit::x64 {

namespace {

constexpr uint32_t kSign = 0x80000000u;
constexpr uint32_t kMagnitude = 0x7fffffffu;

// Rounding modes of vroundps and vrndscaleps, without the precision exception.
constexpr int kNearest = 8, kDown = 9, kUp = 10, kTowardsZero = 11;

}  // namespace

void Emit::binary(InstId id, bool commutative) {
    x86::Vec to = target();
    binary_into(to, id, now(), commutative, nullptr);
    finish(to);
}

// `under`, if given: lanes that are off keep what `to` holds.
void Emit::binary_into(const x86::Vec& to, InstId id, const Inst& op, bool commutative,
                       const x86::KReg* under) {
    Value a = op.a, b = op.b;
    if (commutative && !in_register(a) && in_register(b)) std::swap(a, b);
    x86::Vec left = reg(a, 1);
    Operand right = operand(b);
    if (under != nullptr) a_.k(*under);
    a_.emit(id, to, left, right);
}

void Emit::unary(InstId id) {
    x86::Vec to = target();
    a_.emit(id, to, operand(now().a));
    finish(to);
}

void Emit::unary_imm(InstId id, int imm) {
    x86::Vec to = target();
    a_.emit(id, to, operand(now().a), asmjit::Imm(imm));
    finish(to);
}

void Emit::with_constant(InstId id, uint32_t bits) {
    x86::Vec left = reg(now().a, 1);
    x86::Vec to = target();
    a_.emit(id, to, left, constant(bits));
    finish(to);
}

void Emit::shift(InstId id) {
    x86::Vec left = reg(now().a, 1);
    x86::Vec to = target();
    a_.emit(id, to, left, asmjit::Imm(now().imm));
    finish(to);
}

void Emit::op_Add() {
    binary(Id::kIdVaddps, true);
}
void Emit::op_Sub() {
    binary(Id::kIdVsubps, planted(PlantedFault::SwappedOperands));
}
void Emit::op_Mul() {
    binary(Id::kIdVmulps, true);
}
void Emit::op_Div() {
    binary(Id::kIdVdivps, false);
}
// vminps is a < b ? a : b to the bit: the second operand if either is NaN or both are zeros.
void Emit::op_Min() {
    binary(Id::kIdVminps, false);
}
void Emit::op_Max() {
    binary(Id::kIdVmaxps, false);
}
void Emit::op_Neg() {
    with_constant(Id::kIdVxorps, kSign);
}
void Emit::negate_into(const x86::Vec& to, Value v, const x86::KReg* under) {
    x86::Vec from = reg(v, 1);
    if (under != nullptr) a_.k(*under);
    a_.emit(Id::kIdVxorps, to, from, constant(kSign));
}
void Emit::op_Abs() {
    with_constant(Id::kIdVandps, kMagnitude);
}
void Emit::op_Sqrt() {
    unary(Id::kIdVsqrtps);
}
void Emit::op_Floor() {
    unary_imm(isa_.wide ? Id::kIdVrndscaleps : Id::kIdVroundps, kDown);
}
void Emit::op_Ceil() {
    unary_imm(isa_.wide ? Id::kIdVrndscaleps : Id::kIdVroundps,
              planted(PlantedFault::WrongRounding) ? kDown : kUp);
}
void Emit::op_Trunc() {
    unary_imm(isa_.wide ? Id::kIdVrndscaleps : Id::kIdVroundps, kTowardsZero);
}
void Emit::op_Round() {
    unary_imm(isa_.wide ? Id::kIdVrndscaleps : Id::kIdVroundps, kNearest);
}

void Emit::op_IAdd() {
    binary(Id::kIdVpaddd, true);
}
void Emit::op_ISub() {
    binary(Id::kIdVpsubd, false);
}
void Emit::op_IMul() {
    binary(Id::kIdVpmulld, true);
}
void Emit::op_IAnd() {
    binary(isa_.wide ? Id::kIdVpandd : Id::kIdVpand, true);
}
void Emit::op_IOr() {
    binary(isa_.wide ? Id::kIdVpord : Id::kIdVpor, true);
}
void Emit::op_IXor() {
    binary(isa_.wide ? Id::kIdVpxord : Id::kIdVpxor, true);
}
void Emit::op_IMin() {
    binary(Id::kIdVpminsd, true);
}
void Emit::op_IMax() {
    binary(Id::kIdVpmaxsd, true);
}
void Emit::op_IShl() {
    shift(Id::kIdVpslld);
}
void Emit::op_IShr() {
    shift(Id::kIdVpsrld);
}
void Emit::op_ISar() {
    shift(planted(PlantedFault::WrongShift) ? Id::kIdVpsrld : Id::kIdVpsrad);
}

void Emit::op_FToI() {
    unary(Id::kIdVcvttps2dq);
}
void Emit::op_IToF() {
    unary(Id::kIdVcvtdq2ps);
}
void Emit::op_BitsFI() {
    x86::Vec to = target();
    load(to, now().a);
    finish(to);
}
void Emit::op_BitsIF() {
    op_BitsFI();
}

namespace {

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

void Emit::op_Fma() {
    x86::Vec to = target();
    fma_into(to, now(), nullptr);
    finish(to);
}

bool Emit::lies_in(const x86::Vec& r, Value v) const {
    return in_register(v) && static_cast<uint32_t>(place(root(v)).reg) == r.id();
}

// The destination is one of the operands: a dying one whose register we were given, else one that
// is loaded from memory anyway, else a copy of the addend. With `under` it must be the first.
void Emit::fma_into(const x86::Vec& to, const Inst& fma, const x86::KReg* under) {
    bool negative[3] = {};
    Value v[3] = {fma.a, fma.b, fma.c};
    for (int k = 0; k < 3; ++k)
        if (plan_.values[v[k]].fused) {
            negative[k] = true;
            v[k] = inst(v[k]).a;
        }
    if (planted(PlantedFault::FmaNegationLost)) negative[2] = false;
    auto [a, b, c] = v;
    const FmaForm& form = kFma[negative[0] != negative[1]][negative[2]];
    auto emit = [&](InstId id, const x86::Vec& second, const Operand& third) {
        if (under != nullptr) a_.k(*under);
        a_.emit(id, to, second, third);
    };
    if (lies_in(to, b) || (!in_register(a) && in_register(b))) std::swap(a, b);
    if (lies_in(to, a) && !lies_in(to, c)) {
        x86::Vec second = reg(in_register(b) ? b : c, 1);
        if (in_register(b))
            emit(planted(PlantedFault::FmaFormsMixed) ? form.mul13_add2 : form.mul12_add3, second,
                 operand(c));
        else
            emit(form.mul13_add2, second, operand(b));
    } else if (!lies_in(to, c) && in_register(c) && !in_register(b)) {
        // Not in place: start from the factor that is in memory.
        load(to, b);
        emit(form.mul12_add3, reg(a, 1), operand(c));
    } else {
        x86::Vec factor = reg(a, 1);
        if (!lies_in(to, c)) load(to, c);
        emit(form.mul23_add1, factor, operand(b));
    }
}

// Constants, frame values and inputs are operands in memory; those that were given a register are
// loaded where their range begins.
void Emit::op_ConstF() {}
void Emit::op_ConstI() {}
void Emit::op_ConstM() {}
void Emit::op_Param() {
    if (!is_mask(at_)) return;
    x86::KReg to = mask_target();
    a_.kmovw(to, row(layout_.params + kRow * now().imm));
    finish_mask(to);
}
void Emit::op_Input() {
    if (!is_mask(at_)) return;
    x86::Gp pointer = next_gp();
    a_.mov(pointer, x86::ptr(x86::r12, 8 * now().imm));
    load_result(x86::ptr(pointer, x86::rbp));
}
void Emit::op_FrameLoad() {
    if (!is_mask(at_)) return;
    x86::Vec lanes = scratch(0);
    a_.vbroadcastss(lanes, x86::ptr(x86::r14, 4 * now().imm));
    finish_typed(lanes);
}
void Emit::op_Merge() {}
void Emit::op_LoopOut() {}
// The derivatives pass leaves none.
void Emit::op_Du() {}
void Emit::op_Dv() {}
void Emit::op_WithSlope() {}

}  // namespace kinora::jit::x64
