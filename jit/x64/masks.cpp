// jit/x64/masks.cpp: comparisons, mask logic, and what general registers learn of a mask.
#include "jit/x64/masks_p.h"

#include <utility>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

namespace {

// Predicates of vcmpps and vpcmpd for each comparison: [negated][operands swapped]. Quiet; the
// negated ones are true on NaN.
struct Predicates {
    Op op;
    bool integer;
    int imm[2][2];
};
constexpr Predicates kPredicates[] = {
    {Op::Lt, false, {{0x11, 0x1e}, {0x15, 0x1a}}},  // LT_OQ GT_OQ, NLT_UQ NGT_UQ
    {Op::Le, false, {{0x12, 0x1d}, {0x16, 0x19}}},  // LE_OQ GE_OQ, NLE_UQ NGE_UQ
    {Op::Eq, false, {{0x00, 0x00}, {0x04, 0x04}}},  // EQ_OQ, NEQ_UQ
    {Op::ILt, true, {{1, 6}, {5, 2}}},              // LT NLE, NLT LE
    {Op::IEq, true, {{0, 0}, {4, 4}}},              // EQ, NEQ
};

struct Compare {
    InstId id;
    int imm;
};

Compare predicate(Op op, bool negate, bool swapped) {
    const Predicates* row = kPredicates;
    while (row->op != op) ++row;
    return {row->integer ? Id::kIdVpcmpd : Id::kIdVcmpps, row->imm[negate][swapped]};
}

}  // namespace

// `under`, if given, is a k register that the result is anded with for free.
void Masks::compare_into(const Operand& to, const Inst& compare, bool negate,
                         const x86::KReg* under) {
    Value a = compare.a, b = compare.b;
    if (planted(PlantedFault::NegatedCompareLost)) negate = false;
    bool integer = compare.op == Op::ILt || compare.op == Op::IEq;
    if (integer && !isa_.wide) {
        // There is only "greater" and "equal".
        if (compare.op == Op::ILt) std::swap(a, b);
        x86::Vec left = operands_.reg(a, 1);
        a_.emit(compare.op == Op::ILt ? Id::kIdVpcmpgtd : Id::kIdVpcmpeqd, to, left,
                operands_.operand(b));
        return;
    }
    bool swapped = !cursor_.in_register(a) && cursor_.in_register(b);
    if (swapped) std::swap(a, b);
    bool mirrored = swapped && !planted(PlantedFault::PredicateNotMirrored);
    Compare how = predicate(compare.op, negate, mirrored);
    x86::Vec left = operands_.reg(a, 1);
    Operand right = operands_.operand(b);
    if (under != nullptr) a_.k(*under);
    a_.emit(how.id, to, left, right, asmjit::Imm(how.imm));
}

void Masks::compare() {
    if (isa_.wide) {
        compare_into(operands_.mask_target(), *cursor_, false, nullptr);
        operands_.finish_mask(operands_.mask_target());
    } else {
        compare_into(operands_.target(), *cursor_, false, nullptr);
        operands_.finish(operands_.target());
    }
}

void Masks::op_Lt() {
    compare();
}
void Masks::op_Le() {
    compare();
}
void Masks::op_Eq() {
    compare();
}
void Masks::op_ILt() {
    compare();
}
void Masks::op_IEq() {
    compare();
}

void Masks::logic(InstId wide_id, InstId id) {
    if (!isa_.wide) return plain_.binary(id, true);
    x86::KReg a = operands_.mask_reg(cursor_->a, 0), b = operands_.mask_reg(cursor_->b, 7);
    a_.emit(wide_id, operands_.mask_target(), a, b);
    operands_.finish_mask(operands_.mask_target());
}

void Masks::op_MAnd() {
    Value a = cursor_->a, b = cursor_->b;
    bool a_fused = cursor_.plan(a).fused, b_fused = cursor_.plan(b).fused;
    if (!a_fused && !b_fused) return logic(Id::kIdKandw, Id::kIdVandps);
    x86::KReg under = operands_.mask_reg(a_fused ? b : a, 7);
    compare_into(operands_.mask_target(), cursor_.inst(a_fused ? a : b), false, &under);
    operands_.finish_mask(operands_.mask_target());
}

void Masks::op_MOr() {
    logic(Id::kIdKorw, Id::kIdVorps);
}
void Masks::op_MXor() {
    logic(Id::kIdKxorw, Id::kIdVxorps);
}

void Masks::op_MAndNot() {
    Value kept = cursor_->a, cleared = cursor_->b;
    if (cursor_.plan(cleared).fused) {
        x86::KReg under = operands_.mask_reg(kept, 7);
        compare_into(operands_.mask_target(), cursor_.inst(cleared), true, &under);
        operands_.finish_mask(operands_.mask_target());
    } else if (isa_.wide) {
        x86::KReg a = operands_.mask_reg(kept, 0), b = operands_.mask_reg(cleared, 7);
        if (planted(PlantedFault::AndNotMirrored)) std::swap(a, b);
        a_.kandnw(operands_.mask_target(), b, a);
        operands_.finish_mask(operands_.mask_target());
    } else {
        if (planted(PlantedFault::AndNotMirrored)) std::swap(kept, cleared);
        x86::Vec b = operands_.reg(cleared, 1);
        x86::Vec to = operands_.target();
        a_.emit(Id::kIdVandnps, to, b, operands_.operand(kept));
        operands_.finish(to);
    }
}

void Masks::op_MNot() {
    bool fused = cursor_.plan(cursor_->a).fused;
    if (isa_.wide) {
        x86::KReg to = operands_.mask_target();
        if (fused)
            compare_into(to, cursor_.inst(cursor_->a), true, nullptr);
        else
            a_.knotw(to, operands_.mask_reg(cursor_->a, 0));
        operands_.finish_mask(to);
    } else if (fused) {
        compare_into(operands_.target(), cursor_.inst(cursor_->a), true, nullptr);
        operands_.finish(operands_.target());
    } else {
        plain_.with_constant(Id::kIdVxorps, ~0u);
    }
}

void Masks::set_if_any(Value mask) {
    if (isa_.wide) {
        x86::KReg k = operands_.mask_reg(mask, 7);
        a_.kortestw(k, k);
    } else {
        a_.vmovmskps(x86::eax, operands_.reg(mask, 1));
        a_.test(x86::eax, x86::eax);
    }
}

void Masks::lane_bits(const x86::Gp& to, Value mask) {
    if (isa_.wide)
        a_.kmovw(to, operands_.mask_reg(mask, 7));
    else
        a_.vmovmskps(to, operands_.reg(mask, 1));
}

}  // namespace kinora::jit::x64
