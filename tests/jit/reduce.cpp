// tests/jit/reduce.cpp: greedy reduction, one instruction at a time.
#include "tests/jit/reduce.h"

#include <algorithm>

#include "jit/compiler.h"
#include "jit/ir/fold_inst.h"
#include "jit/passes/passes.h"

namespace kinora::jit::test {

namespace {

using Fails = std::function<bool(const Module&)>;

bool accept(Module& module, const Module& smaller, const Fails& fails) {
    if (!verify(smaller).empty() || !fails(smaller)) return false;
    module = smaller;
    return true;
}

// The instruction made harmless: a zero, or an effect on no lane. False if there is no way.
bool disarm(Function& function, Value v) {
    Inst& inst = function.insts[v];
    uint8_t flags = op_info(inst.op).flags;
    if ((flags & (kPure | kRead)) && !is_constant(inst)) {
        inst = {.op = constant_op(inst.type), .type = inst.type};
        return true;
    }
    // Constants stand anywhere, so an effect without a value can become one.
    if (inst.op == Op::Fault || inst.op == Op::ArrayStore) {
        inst = {.op = Op::ConstI, .type = Type::I};
        return true;
    }
    return false;
}

// All uses of v see w instead.
void bypass(Function& function, Value v, Value w) {
    for (Inst& inst : function.insts) {
        Value* operands[] = {&inst.a, &inst.b, &inst.c};
        for (int k = 0; k < op_info(inst.op).operand_count; ++k)
            if (*operands[k] == v) *operands[k] = w;
    }
    for (Value& arg : function.args)
        if (arg == v) arg = w;
}

// A value gives way to one that it is computed from; what a region leaves to what went in.
bool bypass_each(Module& module, const Fails& fails) {
    bool any = false;
    for (size_t f = 0; f < module.functions.size(); ++f)
        for (size_t k = module.functions[f].insts.size(); k-- > 0;) {
            const Inst inst = module.functions[f].insts[k];
            const Inst* from = &inst;
            if (inst.op == Op::LoopOut) from = &module.functions[f].insts[inst.a];
            const Value operands[] = {from->a, from->b, from->c};
            for (int i = 0; i < op_info(from->op).operand_count; ++i) {
                const Function& function = module.functions[f];
                if (operands[i] >= k || function.insts[operands[i]].type != inst.type ||
                    inst.type == Type::None)
                    continue;
                Module smaller = module;
                bypass(smaller.functions[f], static_cast<Value>(k), operands[i]);
                dce(smaller);
                if (smaller.functions.size() <= f ||
                    smaller.functions[f].insts.size() >= function.insts.size())
                    continue;
                if (!accept(module, smaller, fails)) continue;
                any = true;
                break;
            }
            if (f >= module.functions.size()) return any;
            k = std::min(k, module.functions[f].insts.size());
        }
    return any;
}

size_t instructions(const Module& module) {
    size_t count = 0;
    for (const Function& function : module.functions) count += function.insts.size();
    return count;
}

bool disarm_each(Module& module, const Fails& fails) {
    bool any = false;
    for (size_t f = 0; f < module.functions.size(); ++f)
        for (size_t k = module.functions[f].insts.size(); k-- > 0;) {
            Module smaller = module;
            if (!disarm(smaller.functions[f], static_cast<Value>(k))) continue;
            any |= accept(module, smaller, fails);
        }
    return any;
}

}  // namespace

Module reduce(Module module, const Fails& fails) {
    for (int round = 0; round < 5; ++round) {
        bool any = disarm_each(module, fails);
        size_t before = instructions(module);
        for (auto* pass : {dce, fold, cse, inline_calls}) {
            Module smaller = module;
            pass(smaller);
            if (instructions(smaller) < instructions(module)) accept(module, smaller, fails);
        }
        any |= bypass_each(module, fails);
        if (!any && instructions(module) == before) break;
    }
    return module;
}

}  // namespace kinora::jit::test
