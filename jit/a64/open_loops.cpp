// jit/a64/open_loops.cpp: the loops around the instruction in work, and what counts their rounds.
#include "jit/a64/open_loops_p.h"

#include <cstddef>
#include <iterator>

#include "jit/codegen/loop_slices_p.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit::a64 {

namespace {

// Registers that count iterations, by depth of the loop; deeper ones count in memory.
constexpr Gp kCounters[] = {arm::w10, arm::w11, arm::w12, arm::w13};

}  // namespace

void OpenLoops::open(Value begin) {
    OpenLoop loop{begin, a_.newLabel(), a_.newLabel(), {}};
    bool kept = !code_.plan.calls || planted(PlantedFault::CountersAcrossCalls);
    if (kept && loops_.size() < std::size(kCounters)) loop.counter = kCounters[loops_.size()];
    loops_.push_back(loop);
}

arm::Mem OpenLoops::slot(int32_t first) {
    auto depth = static_cast<int32_t>(loops_.size() - 1);
    return operands_.address(kStack, first + 4 * depth, 4);
}

void OpenLoops::write_counter(int32_t rounds) {
    const OpenLoop& loop = innermost();
    Gp counter = loop.counter.isValid() ? loop.counter : arm::w16;
    a_.mov(counter, rounds);
    if (!loop.counter.isValid()) a_.str(counter, counter_slot());
}

void OpenLoops::set_counter() {
    int32_t budget = code_.module.loop_budget + planted(PlantedFault::LoopBudgetOffByOne);
    Slices slices = slices_of(budget, code_.plan.slices[innermost().begin]);
    write_counter(slices.first);
    if (slices.length == 0) return;
    a_.mov(arm::w16, slices.more);
    a_.str(arm::w16, slices_left());
}

void OpenLoops::begin_next_slice() {
    int32_t length = code_.plan.slices[innermost().begin];
    if (length == 0) return;
    Label last = a_.newLabel();
    a_.ldr(arm::w16, slices_left());
    a_.cbz(arm::w16, last);
    a_.sub(arm::w16, arm::w16, 1);
    a_.str(arm::w16, slices_left());
    a_.ldr(arm::x16, arm::ptr(kArgs, offsetof(KernelArgs, stop)));
    a_.ldr(arm::w16, arm::ptr(arm::x16));
    branches_.if_not_zero(arm::w16, innermost().exit);
    write_counter(length);
    a_.b(innermost().header);
    a_.bind(last);
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
