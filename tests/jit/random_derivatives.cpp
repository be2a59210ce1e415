// tests/jit/random_derivatives.cpp: adds Du and Dv to a random module.
#include "jit/ir/rewrite_p.h"
#include "tests/jit/random_module.h"
#include "tests/jit/world.h"

namespace kinora::jit::test {

Module with_derivatives(const Module& module, uint64_t seed) {
    Module m = module;
    std::mt19937_64 rng(seed);
    m.inputs[0].du = "1";
    m.inputs[1].du = "p0";
    m.inputs[1].dv = "f0";
    for (size_t k = 0; k < kArrayInputs; ++k) m.inputs[kPointArray + k].dv = "p1";
    for (Function& function : m.functions) {
        std::vector<Value> top;  // derivatives outside of regions
        Value outside = kNone;   // the last value outside of regions
        int depth = 0;
        Rewrite r(function);
        for (Value v = 0; v < r.old.size(); ++v) {
            const Inst& inst = r.old[v];
            depth += (inst.op == Op::If || inst.op == Op::Loop) -
                     (inst.op == Op::EndIf || inst.op == Op::EndLoop);
            if (inst.op == Op::Return && &function == &m.functions[0]) {
                for (size_t k = 0; k < 2; ++k)
                    top.insert(top.begin(), r.append({.op = k == 0 ? Op::Du : Op::Dv,
                                                      .type = Type::F,
                                                      .a = r.renamed[r.old_args_of(inst)[1 + k]]}));
            }
            r.copy(v);
            if (!is_pure(inst.op) || inst.type != Type::F) continue;
            if (outside != kNone && rng() % 8 == 0)
                r.renamed[v] = r.append(
                    {.op = Op::WithSlope, .type = Type::F, .a = r.renamed[v], .b = outside});
            if (depth == 0) outside = r.renamed[v];
            if (rng() % 4 != 0) continue;
            Op op = rng() % 2 == 0 ? Op::Du : Op::Dv;
            Value d = r.append({.op = op, .type = Type::F, .a = r.renamed[v]});
            if (depth == 0) top.push_back(d);
        }
        if (&function != &m.functions[0]) continue;
        Inst& end = function.insts.back();
        std::vector<Value> results(function.args_of(end).begin(), function.args_of(end).end());
        results.insert(results.end(), top.begin(), top.begin() + 2);
        end.args = static_cast<uint32_t>(function.args.size());
        end.arg_count = static_cast<uint16_t>(results.size());
        function.args.insert(function.args.end(), results.begin(), results.end());
        function.results.insert(function.results.end(), {Type::F, Type::F});
        m.outputs.push_back({"du", Type::F});
        m.outputs.push_back({"dv", Type::F});
    }
    return m;
}

}  // namespace kinora::jit::test
