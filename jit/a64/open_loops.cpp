// jit/a64/open_loops.cpp: the loops around the instruction in work, and what counts their rounds.
#include "jit/a64/open_loops_p.h"

#include <iterator>

#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

namespace {

// Registers that count iterations, by depth of the loop; deeper ones count in memory.
constexpr Gp kCounters[] = {arm::w10, arm::w11, arm::w12, arm::w13};

}  // namespace

void OpenLoops::open() {
    OpenLoop loop{a_.newLabel(), a_.newLabel(), {}};
    bool kept = !code_.plan.calls || planted(PlantedFault::CountersAcrossCalls);
    if (kept && loops_.size() < std::size(kCounters)) loop.counter = kCounters[loops_.size()];
    loops_.push_back(loop);
}

arm::Mem OpenLoops::counter_slot() {
    auto depth = static_cast<int32_t>(loops_.size() - 1);
    return operands_.address(kStack, code_.layout.counters + 4 * depth, 4);
}

void OpenLoops::set_counter() {
    const OpenLoop& loop = innermost();
    Gp budget = loop.counter.isValid() ? loop.counter : arm::w16;
    a_.mov(budget, code_.module.loop_budget + planted(PlantedFault::LoopBudgetOffByOne));
    if (!loop.counter.isValid()) a_.str(budget, counter_slot());
}

void OpenLoops::count_down() {
    const OpenLoop& loop = innermost();
    Gp left = loop.counter.isValid() ? loop.counter : arm::w16;
    if (!loop.counter.isValid()) a_.ldr(left, counter_slot());
    a_.sub(left, left, 1);
    if (!loop.counter.isValid()) a_.str(left, counter_slot());
    branches_.if_not_zero(left, loop.header);
}

}  // namespace kinora::jit::a64
