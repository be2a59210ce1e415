// jit/codegen/loop_updates.cpp: the order in which a loop's variables get their next values.
#include "jit/codegen/loop_updates_p.h"

#include <set>

#include "jit/ir/planted_fault.h"

namespace kinora::jit {

// A variable that another one reads waits for that one; where all wait for each other, one is
// saved. A loop may have thousands: `readers` and `ready` say which may go without looking at all.
std::vector<LoopUpdate> loop_updates(const FunctionCode& code, Value loop) {
    const Inst& end = code.inst(code.structure.end_of[loop]);
    std::span<const Value> next = code.function.args_of(end);
    const Value next_mask = code.root(end.a);
    const size_t count = next.size();
    auto variable = [&](size_t k) { return loop + 1 + static_cast<Value>(k); };
    auto place = [&](Value v) { return v > loop ? size_t(v - loop - 1) : count; };
    std::vector<LoopUpdate> steps;
    std::vector<Value> wanted(count, kNone);  // of variables that wait
    std::vector<int> readers(count);          // waiting ones
    size_t waiting = 0;
    for (size_t k = 0; k < count; ++k) {
        if (variable(k) == code.plan.counted[loop]) continue;
        if (code.root(next[k]) == variable(k) || code.plan.values[next[k]].alias == variable(k))
            continue;
        wanted[k] = code.root(next[k]);
        ++waiting;
        if (place(wanted[k]) < count) ++readers[place(wanted[k])];
    }
    std::set<size_t> ready;
    for (size_t k = 0; k < count; ++k) {
        if (wanted[k] == kNone) continue;
        // The next mask is read last, after the variable it may be.
        const bool is_mask = variable(k) == next_mask;
        if (is_mask) steps.push_back({variable(k), kNone, 1});
        if (is_mask || readers[k] == 0 || planted(PlantedFault::LoopVariablesInTurn))
            ready.insert(k);
    }
    for (size_t first = 0; waiting > 0; --waiting) {
        if (ready.empty()) {
            while (wanted[first] == kNone) ++first;
            steps.push_back({variable(first), kNone, 0});
            ready.insert(first);
        }
        const size_t k = *ready.begin();
        ready.erase(ready.begin());
        const size_t read = place(wanted[k]);
        steps.push_back({variable(k), wanted[k]});
        wanted[k] = kNone;
        if (read < count && --readers[read] == 0 && wanted[read] != kNone) ready.insert(read);
    }
    return steps;
}

}  // namespace kinora::jit
