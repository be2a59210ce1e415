// jit/passes/inline_calls.cpp: bodies of small or once-called functions replace their calls.
//
// A body inlined runs for all lanes, not for those of the call's mask only: its effects carry masks
// of their own, and results in other lanes are free.
#include "jit/ir/analysis.h"
#include "jit/ir/planted_fault.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

constexpr size_t kSmall = 40;                // instructions worth copying anywhere
constexpr int32_t kMaxClearedElements = 64;  // of arrays that an inlined body must clear itself

class Inliner {
  public:
    explicit Inliner(Module& module)
        : m_(module),
          sites_(module.functions.size(), 0),
          done_(module.functions.size(), false),
          cyclic_(cyclic_functions(module)) {
        for (const Function& function : m_.functions)
            for (const Inst& inst : function.insts)
                if (inst.op == Op::Call) ++sites_[static_cast<size_t>(inst.imm)];
    }

    void run() {
        for (size_t k = 0; k < m_.functions.size(); ++k) finish(k);
    }

  private:
    // Callees first, so that a small caller of small functions is judged by its whole size.
    void finish(size_t index) {
        if (done_[index]) return;
        done_[index] = true;
        bool any = false;
        for (size_t k = 0; k < m_.functions[index].insts.size(); ++k) {
            const Inst& inst = m_.functions[index].insts[k];
            if (inst.op != Op::Call) continue;
            finish(static_cast<size_t>(inst.imm));
            any |= worth_it(static_cast<size_t>(inst.imm));
        }
        if (any) rewrite(m_.functions[index]);
    }

    bool worth_it(size_t callee) const {
        const Function& function = m_.functions[callee];
        int64_t elements = 0;
        for (const ArrayInfo& array : function.arrays) elements += array.cleared;
        if (elements > kMaxClearedElements || cyclic_[callee]) return false;
        return sites_[callee] == 1 || function.insts.size() < kSmall;
    }

    void rewrite(Function& function) {
        Rewrite r(function);
        for (Value v = 0; v < r.old.size();) {
            const Inst& inst = r.old[v];
            auto callee = static_cast<size_t>(inst.imm);
            if (inst.op == Op::Call && worth_it(callee)) {
                v = inline_call(r, v, m_.functions[callee]);
            } else {
                r.copy(v);
                ++v;
            }
        }
    }

    // Copies the callee's stream; returns the instruction after the call's results.
    Value inline_call(Rewrite& r, Value call, const Function& callee) {
        auto first_array = static_cast<int32_t>(r.function.arrays.size());
        clear_arrays(r, callee, first_array);
        std::vector<Value> names(callee.insts.size(), kNone);
        for (Value v = 0; v + 1 < callee.insts.size(); ++v) {
            Inst inst = callee.insts[v];
            if (inst.op == Op::Param) {
                Value arg = r.old_args_of(r.old[call])[static_cast<size_t>(inst.imm)];
                names[v] = r.renamed[arg];
                continue;
            }
            rename(r, inst, callee, names);
            if (inst.op == Op::ArrayLoad || inst.op == Op::ArrayStore) inst.imm += first_array;
            if (inst.where == 0) inst.where = r.old[call].where;
            names[v] = r.append(inst);
        }
        const Inst& end = callee.insts.back();
        Value next = call + 1;
        for (Value result : callee.args_of(end)) r.renamed[next++] = names[result];
        return next;
    }

    static void rename(Rewrite& r, Inst& inst, const Function& callee,
                       const std::vector<Value>& names) {
        for (Value* operand : {&inst.a, &inst.b, &inst.c})
            if (*operand != kNone) *operand = names[*operand];
        if (names_region(inst.op))
            inst.imm = static_cast<int32_t>(names[static_cast<Value>(inst.imm)]);
        if (inst.arg_count == 0) return;
        std::span<const Value> args = callee.args_of(inst);
        inst.args = static_cast<uint32_t>(r.function.args.size());
        for (Value arg : args) r.function.args.push_back(names[arg]);
    }

    // A function's arrays are cleared at each entry; the caller's only at its own.
    static void clear_arrays(Rewrite& r, const Function& callee, int32_t first_array) {
        if (callee.arrays.empty()) return;
        Value all = r.append({.op = Op::ConstM, .type = Type::M, .imm = 1});
        for (size_t k = 0; k < callee.arrays.size(); ++k) {
            const ArrayInfo& array = callee.arrays[k];
            r.function.arrays.push_back(array);
            if (planted(PlantedFault::InlinedArraysKept)) continue;
            Value zero = r.append(
                {.op = array.type == Type::F ? Op::ConstF : Op::ConstI, .type = array.type});
            for (int32_t i = 0; i < array.cleared; ++i) {
                Value index = r.append({.op = Op::ConstI, .type = Type::I, .imm = i});
                r.append({.op = Op::ArrayStore,
                          .a = index,
                          .b = zero,
                          .c = all,
                          .imm = first_array + static_cast<int32_t>(k)});
            }
        }
    }

    Module& m_;
    std::vector<int> sites_;
    std::vector<bool> done_;
    std::vector<bool> cyclic_;
};

}  // namespace

void inline_calls(Module& module) {
    Inliner(module).run();
}

}  // namespace kinora::jit
