// jit/x64/open_loops.cpp: the loops around the instruction in work, and what counts their rounds.
#include "jit/x64/open_loops_p.h"

#include <cstddef>
#include <iterator>

#include "jit/codegen/loop_slices_p.h"
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

x86::Mem OpenLoops::slot(int32_t first) const {
    auto depth = static_cast<int32_t>(loops_.size() - 1);
    return x86::dword_ptr(x86::r15, first + 4 * depth);
}

void OpenLoops::write_counter(int32_t rounds) {
    if (const OpenLoop& loop = innermost(); loop.counter.isValid())
        a_.mov(loop.counter, rounds);
    else
        a_.mov(counter_slot(), rounds);
}

void OpenLoops::set_counter() {
    const FunctionCode& code = cursor_.code();
    Value loop = innermost().begin;
    int32_t rounds = code.plan.rounds[loop];
    int32_t budget =
        (rounds > 0 ? rounds : code.module.loop_budget) + planted(PlantedFault::LoopBudgetOffByOne);
    Slices slices = slices_of(budget, code.plan.slices[loop]);
    write_counter(slices.first);
    if (slices.length > 0) a_.mov(slices_left(), slices.more);
}

void OpenLoops::begin_next_slice() {
    int32_t length = cursor_.code().plan.slices[innermost().begin];
    if (length == 0) return;
    Label last = a_.newLabel();
    a_.dec(slices_left());
    a_.js(last);
    a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, stop)));
    a_.cmp(x86::dword_ptr(x86::rax), 0);
    a_.jne(innermost().exit);
    write_counter(length);
    a_.jmp(innermost().header);
    a_.bind(last);
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
