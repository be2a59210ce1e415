// jit/ir/fold_inst.h: what one instruction folds to, exactly. Builder and the fold pass share it.
#pragma once

#include "jit/ir/ir.h"

namespace kinora::jit {

// The result of looking at one instruction and those that define its operands.
struct Folded {
    enum Kind : uint8_t { Keep, Same, Constant } kind = Keep;
    Value same = kNone;  // Same: the value it equals
    int32_t bits = 0;    // Constant: of the instruction's type (mask: 0 or 1)
};

// May rewrite `inst` itself to a cheaper equal one (operands swapped, Mul by -1 to Neg); then the
// kind is Keep. Only what holds for every input bit for bit (any NaN equals any NaN): x*1 and
// x+(-0) fold, x*0 and x+0 do not. Pure ops only; others are Keep.
Folded fold_inst(Inst& inst, std::span<const Inst> insts);

// The op on constants, as the interpreter would: operand bits in, result bits out (mask lanes are
// 0 or 1 here). False if the op is no arithmetic.
bool evaluate(const Inst& inst, int32_t a, int32_t b, int32_t c, int32_t* result);

inline bool is_constant(const Inst& inst) {
    return inst.op == Op::ConstF || inst.op == Op::ConstI || inst.op == Op::ConstM;
}
inline bool is_compare(Op op) {
    return op == Op::Lt || op == Op::Le || op == Op::Eq || op == Op::ILt || op == Op::IEq;
}
Op constant_op(Type type);  // ConstF, ConstI, ConstM

}  // namespace kinora::jit
