// jit/ir/analysis.cpp: matching regions, agreeing lanes, effects of functions, rounds of loops.
#include "jit/ir/analysis.h"

#include "jit/ir/fold_inst.h"

#include <algorithm>

namespace kinora::jit {

namespace {

class Agreement {
  public:
    explicit Agreement(const Function& function)
        : f_(function), match_(match_regions(function)), agree_(function.insts.size(), true) {}

    // Starts from "all agree" and takes back until nothing changes: the greatest fixpoint, which a
    // loop variable needs, since it depends on itself.
    std::vector<bool> run() {
        bool changed = true;
        while (changed) {
            changed = false;
            for (Value v = 0; v < f_.insts.size(); ++v) {
                if (!agree_[v] || agrees(v)) continue;
                agree_[v] = false;
                changed = true;
            }
        }
        return std::move(agree_);
    }

  private:
    bool agrees(Value v) const {
        const Inst& inst = f_.insts[v];
        switch (inst.op) {
            case Op::Input:
            case Op::InputGather:
            case Op::RecordField:
            case Op::ArrayLoad:
            case Op::Param:
            case Op::Result:
                return false;
            case Op::Merge: {
                const Inst& begin = f_.insts[static_cast<Value>(inst.imm)];
                return agree_[begin.a] && agree_[inst.a] && agree_[inst.b];
            }
            case Op::Loop:
                return agree_[inst.a] && agree_[f_.insts[match_[v]].a];
            case Op::LoopVar:
                return loop_var_agrees(v, inst);
            default:
                // Control without a value stays "true": nobody reads it.
                return (inst.a == kNone || agree_[inst.a]) && (inst.b == kNone || agree_[inst.b]) &&
                       (inst.c == kNone || agree_[inst.c]);
        }
    }

    // Lanes that leave a loop early keep older values, so the loop's mask must agree too.
    bool loop_var_agrees(Value v, const Inst& inst) const {
        auto begin = static_cast<Value>(inst.imm);
        const Inst& end = f_.insts[match_[begin]];
        return agree_[begin] && agree_[inst.a] && agree_[f_.args_of(end)[v - begin - 1]];
    }

    const Function& f_;
    std::vector<Value> match_;
    std::vector<bool> agree_;
};

bool is_effect(const Module& module, const Inst& inst) {
    if (inst.op == Op::Fault) return true;
    return inst.op == Op::Service && !module.services[static_cast<size_t>(inst.imm)].pure;
}

void find_effects(const Module& module, size_t index, std::vector<uint8_t>& state) {
    if (state[index] != 0) return;
    state[index] = 1;  // visited, no effect yet
    for (const Inst& inst : module.functions[index].insts) {
        if (is_effect(module, inst)) state[index] = 2;
        if (inst.op != Op::Call) continue;
        auto callee = static_cast<size_t>(inst.imm);
        find_effects(module, callee, state);
        if (state[callee] == 2) state[index] = 2;
    }
}

}  // namespace

std::vector<bool> lanes_agree(const Module&, const Function& function) {
    return Agreement(function).run();
}

std::vector<Value> match_regions(const Function& function) {
    std::vector<Value> match(function.insts.size(), kNone);
    for (Value v = 0; v < function.insts.size(); ++v) {
        const Inst& inst = function.insts[v];
        if (inst.op != Op::EndIf && inst.op != Op::EndLoop) continue;
        match[static_cast<Value>(inst.imm)] = v;
        match[v] = static_cast<Value>(inst.imm);
    }
    return match;
}

std::vector<bool> has_effects(const Module& module) {
    std::vector<uint8_t> state(module.functions.size(), 0);
    std::vector<bool> effects(module.functions.size());
    for (size_t k = 0; k < module.functions.size(); ++k) {
        find_effects(module, k, state);
        effects[k] = state[k] == 2;
    }
    return effects;
}

// The condition after k rounds, for k = 1, 2, ... until it is false.
int32_t trip_count(std::span<const Inst> insts, std::span<const Value> next, Value loop, Value end,
                   int32_t budget) {
    constexpr int32_t kMostRounds = 1024;
    const Inst& condition = insts[insts[end].a];
    if (!is_compare(condition.op)) return 0;
    Value stepped = is_constant(insts[condition.a]) ? condition.b : condition.a;
    Value limit = stepped == condition.a ? condition.b : condition.a;
    const Inst& step = insts[stepped];
    bool plain = step.op == Op::Add || step.op == Op::Sub || step.op == Op::IAdd ||
                 step.op == Op::ISub || step.op == Op::Mul;
    if (!plain || !is_constant(insts[limit])) return 0;
    Value variable = is_constant(insts[step.a]) ? step.b : step.a;
    const Inst& first = insts[variable];
    bool ours = first.op == Op::LoopVar && static_cast<Value>(first.imm) == loop &&
                next[variable - loop - 1] == stepped;
    Value by = variable == step.a ? step.b : step.a;
    if (!ours || !is_constant(insts[by]) || !is_constant(insts[first.a])) return 0;
    int32_t at = insts[first.a].imm;
    auto bits = [&](Value v) { return v == variable || v == stepped ? at : insts[v].imm; };
    for (int32_t k = 1; k <= std::min(kMostRounds, budget); ++k) {
        int32_t again = 0;
        evaluate(step, bits(step.a), bits(step.b), 0, &at);
        evaluate(condition, bits(condition.a), bits(condition.b), 0, &again);
        if (again == 0) return k;
    }
    return 0;
}

}  // namespace kinora::jit
