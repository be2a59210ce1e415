// jit/x64/masks.cpp: comparisons, mask logic, and blends under a mask. Masks are k registers
// in AVX-512 and lanes of all ones or zero in AVX2.
#include <utility>

#include "jit/x64/emit_p.h"

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

}  // namespace

Emit::Compare Emit::predicate(Op op, bool negate, bool swapped) const {
    const Predicates* row = kPredicates;
    while (row->op != op) ++row;
    return {row->integer ? Id::kIdVpcmpd : Id::kIdVcmpps, row->imm[negate][swapped]};
}

// `under`, if given, is a k register that the result is anded with for free.
void Emit::compare_into(const Operand& to, const Inst& compare, bool negate,
                        const x86::KReg* under) {
    Value a = compare.a, b = compare.b;
    if (planted(PlantedFault::NegatedCompareLost)) negate = false;
    bool integer = compare.op == Op::ILt || compare.op == Op::IEq;
    if (integer && !isa_.wide) {
        // There is only "greater" and "equal".
        if (compare.op == Op::ILt) std::swap(a, b);
        x86::Vec left = reg(a, 1);
        a_.emit(compare.op == Op::ILt ? Id::kIdVpcmpgtd : Id::kIdVpcmpeqd, to, left, operand(b));
        return;
    }
    bool swapped = !in_register(a) && in_register(b);
    if (swapped) std::swap(a, b);
    bool mirrored = swapped && !planted(PlantedFault::PredicateNotMirrored);
    Compare how = predicate(compare.op, negate, mirrored);
    x86::Vec left = reg(a, 1);
    Operand right = operand(b);
    if (under != nullptr) a_.k(*under);
    a_.emit(how.id, to, left, right, asmjit::Imm(how.imm));
}

void Emit::compare() {
    if (isa_.wide) {
        compare_into(mask_target(), now(), false, nullptr);
        finish_mask(mask_target());
    } else {
        compare_into(target(), now(), false, nullptr);
        finish(target());
    }
}

void Emit::op_Lt() {
    compare();
}
void Emit::op_Le() {
    compare();
}
void Emit::op_Eq() {
    compare();
}
void Emit::op_ILt() {
    compare();
}
void Emit::op_IEq() {
    compare();
}

void Emit::mask_binary(InstId wide_id, InstId id) {
    if (!isa_.wide) return binary(id, true);
    x86::KReg a = mask_reg(now().a, 0), b = mask_reg(now().b, 7);
    a_.emit(wide_id, mask_target(), a, b);
    finish_mask(mask_target());
}

void Emit::op_MAnd() {
    bool a_fused = plan_.values[now().a].fused, b_fused = plan_.values[now().b].fused;
    if (!a_fused && !b_fused) return mask_binary(Id::kIdKandw, Id::kIdVandps);
    x86::KReg under = mask_reg(a_fused ? now().b : now().a, 7);
    compare_into(mask_target(), inst(a_fused ? now().a : now().b), false, &under);
    finish_mask(mask_target());
}

void Emit::op_MOr() {
    mask_binary(Id::kIdKorw, Id::kIdVorps);
}
void Emit::op_MXor() {
    mask_binary(Id::kIdKxorw, Id::kIdVxorps);
}

void Emit::op_MAndNot() {
    if (plan_.values[now().b].fused) {
        x86::KReg under = mask_reg(now().a, 7);
        compare_into(mask_target(), inst(now().b), true, &under);
        finish_mask(mask_target());
    } else if (isa_.wide) {
        x86::KReg a = mask_reg(now().a, 0), b = mask_reg(now().b, 7);
        if (planted(PlantedFault::AndNotMirrored)) std::swap(a, b);
        a_.kandnw(mask_target(), b, a);
        finish_mask(mask_target());
    } else {
        Value kept = now().a, cleared = now().b;
        if (planted(PlantedFault::AndNotMirrored)) std::swap(kept, cleared);
        x86::Vec b = reg(cleared, 1);
        x86::Vec to = target();
        a_.emit(Id::kIdVandnps, to, b, operand(kept));
        finish(to);
    }
}

void Emit::op_MNot() {
    bool fused = plan_.values[now().a].fused;
    if (isa_.wide) {
        x86::KReg to = mask_target();
        if (fused)
            compare_into(to, inst(now().a), true, nullptr);
        else
            a_.knotw(to, mask_reg(now().a, 0));
        finish_mask(to);
    } else if (fused) {
        compare_into(target(), inst(now().a), true, nullptr);
        finish(target());
    } else {
        with_constant(Id::kIdVxorps, ~0u);
    }
}

// to = mask ? then : otherwise
void Emit::blend(const x86::Vec& to, const x86::Vec& otherwise, Value then, Value mask) {
    if (isa_.wide) {
        x86::KReg k = mask_reg(mask, 7);
        Operand right = operand(then);
        a_.k(k);
        a_.emit(Id::kIdVblendmps, to, otherwise, right);
    } else {
        x86::Vec m = reg(mask, 1);
        a_.emit(Id::kIdVblendvps, to, otherwise, operand(then), m);
    }
}

// The same for k registers, as otherwise ^ ((then ^ otherwise) & mask): two scratch registers do,
// wherever the three lie.
void Emit::blend_mask(const x86::KReg& to, Value otherwise, Value then, Value mask) {
    a_.kxorw(x86::k0, mask_reg(then, 0), mask_reg(otherwise, 7));
    a_.kandw(x86::k0, x86::k0, mask_reg(mask, 7));
    a_.kxorw(to, x86::k0, mask_reg(otherwise, 7));
}

void Emit::op_Select() {
    Value mask = now().a, then = now().b, otherwise = now().c;
    if (is_mask(at_)) {
        blend_mask(mask_target(), otherwise, then, mask);
        return finish_mask(mask_target());
    }
    if (plan_.values[then].fused) return select_computed();
    x86::Vec to = target();
    if (isa_.wide && is_zero(otherwise)) {
        x86::KReg k = mask_reg(mask, 7);
        Operand from = operand(then);
        bool word = from.isMem() && from.as<x86::Mem>().hasBroadcast();
        if (word) from.as<x86::Mem>().resetBroadcast();
        planted(PlantedFault::ZeroArmMixed) ? a_.k(k) : a_.k(k).z();
        a_.emit(word ? Id::kIdVbroadcastss : Id::kIdVmovaps, to, from);
    } else if (!isa_.wide && is_zero(otherwise)) {
        x86::Vec m = reg(mask, 1);
        a_.emit(Id::kIdVandps, to, m, operand(then));
    } else if (!isa_.wide && is_zero(then)) {
        x86::Vec m = reg(mask, 1);
        a_.emit(planted(PlantedFault::ZeroArmMixed) ? Id::kIdVandps : Id::kIdVandnps, to, m,
                operand(otherwise));
    } else {
        blend(to, reg(otherwise, 0), then, mask);
    }
    finish(to);
}

void Emit::arm_into(const x86::Vec& to, const Inst& arm, const x86::KReg* under) {
    if (arm.op == Op::Fma) return fma_into(to, arm, under);
    if (arm.op == Op::Neg) return negate_into(to, arm.a, under);
    InstId id = arm.op == Op::Add   ? Id::kIdVaddps
                : arm.op == Op::Sub ? Id::kIdVsubps
                                    : Id::kIdVmulps;
    binary_into(to, id, arm, arm.op != Op::Sub, under);
}

// The arm is computed over the other one where the mask is set; beside it if that lives on.
void Emit::select_computed() {
    Value otherwise = now().c;
    const Inst& arm = inst(now().b);
    x86::Vec to = target();
    if (lies_in(to, otherwise)) {
        x86::KReg k = mask_reg(now().a, 7);
        arm_into(to, arm, &k);
    } else {
        arm_into(scratch(0), arm, nullptr);
        x86::Vec other = reg(otherwise, 1);
        a_.k(mask_reg(now().a, 7));
        a_.emit(Id::kIdVblendmps, to, other, scratch(0));
    }
    finish(to);
}

// Writes `then` into a Merge or LoopVar where the mask is set.
void Emit::merge_into(Value variable, Value then, Value mask) {
    bool memory = place(variable).reg < 0;
    if (is_mask(variable)) {
        x86::KReg to = memory ? x86::k7 : x86::k(static_cast<uint32_t>(place(variable).reg));
        blend_mask(to, variable, then, mask);
        if (memory) store_mask_slot(variable, to);
    } else if (!memory) {
        x86::Vec to = vec(place(variable).reg);
        blend(to, to, then, mask);
    } else if (isa_.wide) {
        // A store under a mask is not forwarded to the load that follows: store whole.
        x86::Vec from = reg(then, 0);
        load_memory(scratch(1), slot(variable));
        a_.k(mask_reg(mask, 7));
        a_.emit(Id::kIdVmovaps, scratch(1), from);
        store_slot(variable, scratch(1));
    } else {
        load_memory(scratch(0), slot(variable));
        blend(scratch(0), scratch(0), then, mask);
        store_slot(variable, scratch(0));
    }
}

// Flags: not zero if a lane of the mask is set.
void Emit::set_if_any(Value mask) {
    if (isa_.wide) {
        x86::KReg k = mask_reg(mask, 7);
        a_.kortestw(k, k);
    } else {
        a_.vmovmskps(x86::eax, reg(mask, 1));
        a_.test(x86::eax, x86::eax);
    }
}

void Emit::mask_bits(const x86::Gp& to, Value mask) {
    if (isa_.wide)
        a_.kmovw(to, mask_reg(mask, 7));
    else
        a_.vmovmskps(to, reg(mask, 1));
}

}  // namespace kinora::jit::x64
