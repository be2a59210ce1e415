// jit/codegen/loop_updates.cpp: the order in which a loop's variables get their next values.
#include "jit/codegen/loop_updates_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit {

namespace {

bool is_read(const std::vector<LoopUpdate>& updates, Value variable, size_t except) {
    for (size_t k = 0; k < updates.size(); ++k)
        if (k != except && updates[k].next == variable) return true;
    return false;
}

}  // namespace

std::vector<LoopUpdate> loop_updates(const FunctionCode& code, Value loop) {
    const Inst& end = code.inst(code.structure.end_of[loop]);
    std::span<const Value> next = code.function.args_of(end);
    Value next_mask = code.root(end.a);
    std::vector<LoopUpdate> waiting, steps;
    Value saved[2] = {kNone, kNone};
    auto save = [&](int row, Value variable) {
        steps.push_back({variable, kNone, row});
        saved[row] = variable;
    };
    for (size_t k = 0; k < next.size(); ++k) {
        Value variable = loop + 1 + static_cast<Value>(k);
        if (variable == code.plan.counted[loop]) continue;
        if (code.root(next[k]) == variable || code.plan.values[next[k]].alias == variable) continue;
        waiting.push_back({variable, code.root(next[k])});
        // The next mask is read last, after the variable it may be.
        if (variable == next_mask) save(1, variable);
    }
    auto must_wait = [&](size_t k) {
        Value variable = waiting[k].variable;
        if (saved[0] == variable || saved[1] == variable) return false;
        return !planted(PlantedFault::LoopVariablesInTurn) && is_read(waiting, variable, k);
    };
    while (!waiting.empty()) {
        size_t k = 0;
        while (k < waiting.size() && must_wait(k)) ++k;
        if (k == waiting.size()) save(0, waiting[k = 0].variable);
        steps.push_back(waiting[k]);
        waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return steps;
}

}  // namespace kinora::jit
