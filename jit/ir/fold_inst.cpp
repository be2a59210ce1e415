// jit/ir/fold_inst.cpp: exact folding of one instruction: constants, identities, operand order.
#include "jit/ir/fold_inst.h"

#include <array>
#include <cmath>
#include <type_traits>

#include "jit/ir/planted_fault.h"
#include "jit/ir/scalar_p.h"

namespace kinora::jit {

namespace {

using Evaluator = int32_t (*)(int32_t a, int32_t b, int32_t c, int32_t imm);

// Feeds operand bits to a scalar function by its signature.
template <class T>
T operand(const int32_t* bits, int index, int32_t imm) {
    if constexpr (std::is_same_v<T, scalar::Imm>)
        return scalar::Imm{imm};
    else if constexpr (std::is_same_v<T, scalar::Mask>)
        return scalar::Mask(bits[index] != 0);
    else
        return std::bit_cast<T>(bits[index]);
}

template <class R, class... A, size_t... I>
int32_t call_on(R (*fn)(A...), const int32_t* bits, int32_t imm, std::index_sequence<I...>) {
    R result = fn(operand<A>(bits, I, imm)...);
    if constexpr (std::is_same_v<R, scalar::Mask>)
        return result.bits != 0;
    else
        return std::bit_cast<int32_t>(result);
}
template <class R, class... A>
int32_t call(R (*fn)(A...), const int32_t* bits, int32_t imm) {
    return call_on(fn, bits, imm, std::index_sequence_for<A...>());
}

constexpr auto kEvaluators = [] {
    std::array<Evaluator, static_cast<size_t>(Op::Count)> table{};
#define ROW(name)                                                                             \
    table[static_cast<size_t>(Op::name)] = [](int32_t a, int32_t b, int32_t c, int32_t imm) { \
        const int32_t bits[] = {a, b, c};                                                     \
        return call(&scalar::name, bits, imm);                                                \
    };
    KINORA_SCALAR_OPS(ROW)
#undef ROW
    return table;
}();

constexpr Folded kKeep{};
Folded same(Value v) {
    return {Folded::Same, v, 0};
}
Folded constant(int32_t bits) {
    return {Folded::Constant, kNone, bits};
}

Folded rewrite(Inst& inst, Op op, Value a, Value b = kNone, Value c = kNone, int32_t imm = 0) {
    inst.op = op;
    inst.a = a;
    inst.b = b;
    inst.c = c;
    inst.imm = imm;
    return kKeep;
}

// One instruction under the rules' eyes.
struct Site {
    Inst& inst;
    std::span<const Inst> insts;

    const Inst& a() const { return insts[inst.a]; }
    const Inst& b() const { return insts[inst.b]; }
    const Inst& c() const { return insts[inst.c]; }
    bool is_f(Value v, float value) const {
        return insts[v].op == Op::ConstF && insts[v].imm == bits_of(value);
    }
    bool is_i(Value v, int32_t value) const {
        return insts[v].op == Op::ConstI && insts[v].imm == value;
    }
    bool is_m(Value v, bool value) const {
        return insts[v].op == Op::ConstM && (insts[v].imm != 0) == value;
    }
};

using Rule = Folded (*)(Site& s);

// x + -0 = x for every x (x + +0 is not: -0 + +0 = +0).
Folded fold_add(Site& s) {
    if (s.is_f(s.inst.b, -0.0f)) return same(s.inst.a);
    if (planted(PlantedFault::ZeroAdded) && s.is_f(s.inst.b, 0.0f)) return same(s.inst.a);
    if (s.b().op == Op::Neg) return rewrite(s.inst, Op::Sub, s.inst.a, s.b().a);
    return kKeep;
}

Folded fold_sub(Site& s) {
    if (s.is_f(s.inst.b, 0.0f)) return same(s.inst.a);
    if (s.b().op == Op::Neg) return rewrite(s.inst, Op::Add, s.inst.a, s.b().a);
    return kKeep;
}

Folded fold_mul(Site& s) {
    if (s.is_f(s.inst.b, 1.0f)) return same(s.inst.a);
    if (s.is_f(s.inst.b, -1.0f)) return rewrite(s.inst, Op::Neg, s.inst.a);
    if (s.a().op == Op::Neg && s.b().op == Op::Neg)
        return rewrite(s.inst, Op::Mul, s.a().a, s.b().a);
    return kKeep;
}

Folded fold_div(Site& s) {
    if (s.is_f(s.inst.b, 1.0f)) return same(s.inst.a);
    if (s.is_f(s.inst.b, -1.0f)) return rewrite(s.inst, Op::Neg, s.inst.a);
    return kKeep;
}

// round(a*1 + c) is a + c, and round(a*b + -0) is a*b, both rounded once.
Folded fold_fma(Site& s) {
    if (s.is_f(s.inst.a, 1.0f)) return rewrite(s.inst, Op::Add, s.inst.b, s.inst.c);
    if (s.is_f(s.inst.b, 1.0f)) return rewrite(s.inst, Op::Add, s.inst.a, s.inst.c);
    if (s.is_f(s.inst.c, -0.0f)) return rewrite(s.inst, Op::Mul, s.inst.a, s.inst.b);
    return kKeep;
}

Folded fold_equal_operands(Site& s) {
    return s.inst.a == s.inst.b ? same(s.inst.a) : kKeep;
}

Folded fold_neg(Site& s) {
    return s.a().op == Op::Neg ? same(s.a().a) : kKeep;
}

Folded fold_abs(Site& s) {
    if (s.a().op == Op::Abs) return same(s.inst.a);
    if (s.a().op == Op::Neg) return rewrite(s.inst, Op::Abs, s.a().a);
    return kKeep;
}

// What is already an integer (or NaN, or infinite) rounds to itself.
Folded fold_rounding(Site& s) {
    Op op = s.a().op;
    bool integral =
        op == Op::Floor || op == Op::Ceil || op == Op::Trunc || op == Op::Round || op == Op::IToF;
    return integral ? same(s.inst.a) : kKeep;
}

Folded fold_iadd(Site& s) {
    return s.is_i(s.inst.b, 0) ? same(s.inst.a) : kKeep;
}

Folded fold_isub(Site& s) {
    if (s.inst.a == s.inst.b) return constant(0);
    return s.is_i(s.inst.b, 0) ? same(s.inst.a) : kKeep;
}

Folded fold_imul(Site& s) {
    if (s.is_i(s.inst.b, 1)) return same(s.inst.a);
    if (s.b().op != Op::ConstI) return kKeep;
    auto factor = static_cast<uint32_t>(s.b().imm);
    if (factor == 0) return constant(0);
    if (!std::has_single_bit(factor)) return kKeep;
    return rewrite(s.inst, Op::IShl, s.inst.a, kNone, kNone, std::countr_zero(factor));
}

Folded fold_iand(Site& s) {
    if (s.inst.a == s.inst.b || s.is_i(s.inst.b, -1)) return same(s.inst.a);
    return s.is_i(s.inst.b, 0) ? constant(0) : kKeep;
}

Folded fold_ior(Site& s) {
    if (s.inst.a == s.inst.b || s.is_i(s.inst.b, 0)) return same(s.inst.a);
    return s.is_i(s.inst.b, -1) ? constant(-1) : kKeep;
}

Folded fold_ixor(Site& s) {
    if (s.inst.a == s.inst.b) return constant(0);
    return s.is_i(s.inst.b, 0) ? same(s.inst.a) : kKeep;
}

Folded fold_shift(Site& s) {
    return s.inst.imm == 0 ? same(s.inst.a) : kKeep;
}

Folded fold_bits_fi(Site& s) {
    return s.a().op == Op::BitsIF ? same(s.a().a) : kKeep;
}
Folded fold_bits_if(Site& s) {
    return s.a().op == Op::BitsFI ? same(s.a().a) : kKeep;
}

// Eq(x, x) is no constant: it asks whether x is a number.
Folded fold_less(Site& s) {
    return s.inst.a == s.inst.b ? constant(0) : kKeep;
}
Folded fold_ieq(Site& s) {
    return s.inst.a == s.inst.b ? constant(1) : kKeep;
}

Folded fold_mand(Site& s) {
    if (s.inst.a == s.inst.b || s.is_m(s.inst.b, true)) return same(s.inst.a);
    return s.is_m(s.inst.b, false) ? constant(0) : kKeep;
}

Folded fold_mor(Site& s) {
    if (s.inst.a == s.inst.b || s.is_m(s.inst.b, false)) return same(s.inst.a);
    return s.is_m(s.inst.b, true) ? constant(1) : kKeep;
}

Folded fold_mxor(Site& s) {
    if (s.inst.a == s.inst.b) return constant(0);
    if (s.is_m(s.inst.b, false)) return same(s.inst.a);
    if (s.is_m(s.inst.b, true)) return rewrite(s.inst, Op::MNot, s.inst.a);
    return kKeep;
}

Folded fold_mandnot(Site& s) {
    if (s.inst.a == s.inst.b || s.is_m(s.inst.a, false) || s.is_m(s.inst.b, true))
        return constant(0);
    if (s.is_m(s.inst.b, false)) return same(s.inst.a);
    if (s.is_m(s.inst.a, true)) return rewrite(s.inst, Op::MNot, s.inst.b);
    if (s.b().op == Op::MNot) return rewrite(s.inst, Op::MAnd, s.inst.a, s.b().a);
    return kKeep;
}

Folded fold_mnot(Site& s) {
    return s.a().op == Op::MNot ? same(s.a().a) : kKeep;
}

Folded fold_select(Site& s) {
    if (s.inst.b == s.inst.c || s.is_m(s.inst.a, true)) return same(s.inst.b);
    if (s.is_m(s.inst.a, false)) return same(s.inst.c);
    if (s.inst.type == Type::M && s.is_m(s.inst.b, true))
        return rewrite(s.inst, Op::MOr, s.inst.a, s.inst.c);
    if (s.inst.type == Type::M && s.is_m(s.inst.c, false))
        return rewrite(s.inst, Op::MAnd, s.inst.a, s.inst.b);
    if (s.a().op == Op::MNot) return rewrite(s.inst, Op::Select, s.a().a, s.inst.c, s.inst.b);
    return kKeep;
}

constexpr auto kRules = [] {
    std::array<Rule, static_cast<size_t>(Op::Count)> table{};
    auto row = [&](Op op, Rule rule) { table[static_cast<size_t>(op)] = rule; };
    row(Op::Add, fold_add);
    row(Op::Sub, fold_sub);
    row(Op::Mul, fold_mul);
    row(Op::Div, fold_div);
    row(Op::Fma, fold_fma);
    row(Op::Min, fold_equal_operands);
    row(Op::Max, fold_equal_operands);
    row(Op::IMin, fold_equal_operands);
    row(Op::IMax, fold_equal_operands);
    row(Op::Neg, fold_neg);
    row(Op::Abs, fold_abs);
    for (Op op : {Op::Floor, Op::Ceil, Op::Trunc, Op::Round}) row(op, fold_rounding);
    row(Op::IAdd, fold_iadd);
    row(Op::ISub, fold_isub);
    row(Op::IMul, fold_imul);
    row(Op::IAnd, fold_iand);
    row(Op::IOr, fold_ior);
    row(Op::IXor, fold_ixor);
    for (Op op : {Op::IShl, Op::IShr, Op::ISar}) row(op, fold_shift);
    row(Op::BitsFI, fold_bits_fi);
    row(Op::BitsIF, fold_bits_if);
    row(Op::Lt, fold_less);
    row(Op::ILt, fold_less);
    row(Op::IEq, fold_ieq);
    row(Op::MAnd, fold_mand);
    row(Op::MOr, fold_mor);
    row(Op::MXor, fold_mxor);
    row(Op::MAndNot, fold_mandnot);
    row(Op::MNot, fold_mnot);
    row(Op::Select, fold_select);
    return table;
}();

bool all_constant(const Inst& inst, std::span<const Inst> insts, int count) {
    return is_constant(insts[inst.a]) && (count < 2 || is_constant(insts[inst.b])) &&
           (count < 3 || is_constant(insts[inst.c]));
}

}  // namespace

Op constant_op(Type type) {
    return type == Type::F ? Op::ConstF : type == Type::I ? Op::ConstI : Op::ConstM;
}

bool evaluate(const Inst& inst, int32_t a, int32_t b, int32_t c, int32_t* result) {
    Evaluator evaluator = kEvaluators[static_cast<size_t>(inst.op)];
    if (evaluator == nullptr) return false;
    *result = evaluator(a, b, c, inst.imm);
    return true;
}

Folded fold_inst(Inst& inst, std::span<const Inst> insts) {
    // A rewrite may open the way to another rule; each makes the instruction simpler.
    for (;;) {
        const OpInfo& info = op_info(inst.op);
        if (kEvaluators[static_cast<size_t>(inst.op)] == nullptr) return kKeep;
        if (all_constant(inst, insts, info.operand_count)) {
            auto bits = [&](Value v) { return v == kNone ? 0 : insts[v].imm; };
            int32_t result = 0;
            evaluate(inst, bits(inst.a), bits(inst.b), bits(inst.c), &result);
            return constant(result);
        }
        if ((info.flags & kCommutative) && is_constant(insts[inst.a])) std::swap(inst.a, inst.b);
        Rule rule = kRules[static_cast<size_t>(inst.op)];
        if (rule == nullptr) return kKeep;
        Op before = inst.op;
        Value a_before = inst.a;
        Site site{inst, insts};
        Folded folded = rule(site);
        bool rewritten = inst.op != before || inst.a != a_before;
        if (folded.kind != Folded::Keep || !rewritten) return folded;
    }
}

}  // namespace kinora::jit
