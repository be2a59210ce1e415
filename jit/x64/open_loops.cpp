// jit/x64/open_loops.cpp: the loops around the instruction in work, and what counts their rounds.
#include "jit/x64/open_loops_p.h"

#include <iterator>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

namespace {

// Registers that count iterations, by depth of the loop; deeper ones count in memory.
constexpr x86::Gp kCounters[] = {x86::r8d, x86::r9d};

}  // namespace

void OpenLoops::open(Value begin) {
    OpenLoop loop{begin, a_.newLabel(), a_.newLabel(), {}};
    bool kept = !cursor_.code().plan.calls || planted(PlantedFault::CountersAcrossCalls);
    if (kept && loops_.size() < std::size(kCounters)) loop.counter = kCounters[loops_.size()];
    loops_.push_back(loop);
}

x86::Mem OpenLoops::counter_slot() const {
    auto depth = static_cast<int32_t>(loops_.size() - 1);
    return x86::dword_ptr(x86::r15, cursor_.code().layout.counters + 4 * depth);
}

void OpenLoops::set_counter() {
    const OpenLoop& loop = innermost();
    int32_t rounds = cursor_.code().plan.rounds[loop.begin];
    int32_t budget = (rounds > 0 ? rounds : cursor_.code().module.loop_budget) +
                     planted(PlantedFault::LoopBudgetOffByOne);
    if (loop.counter.isValid())
        a_.mov(loop.counter, budget);
    else
        a_.mov(counter_slot(), budget);
}

void OpenLoops::count_down() {
    if (const OpenLoop& loop = innermost(); loop.counter.isValid())
        a_.dec(loop.counter);
    else
        a_.dec(counter_slot());
}

const OpenLoop* OpenLoops::counted_by(Value index) const {
    for (const OpenLoop& loop : loops_)
        if (cursor_.code().plan.counted[loop.begin] == index) return &loop;
    return nullptr;
}

void OpenLoops::counted_index(const x86::Gp& to, const OpenLoop& loop, int32_t ahead) {
    const FunctionCode& code = cursor_.code();
    int32_t first = code.inst(code.inst(code.plan.counted[loop.begin]).a).imm;
    a_.mov(to, code.module.loop_budget + first + ahead);
    a_.sub(to, loop.counter);
}

}  // namespace kinora::jit::x64
