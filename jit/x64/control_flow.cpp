// jit/x64/control_flow.cpp: If and Loop.
#include "jit/x64/control_flow_p.h"

#include <cstddef>

namespace kinora::jit::x64 {

void ControlFlow::op_If() {
    joins_.begin_merges();
    ifs_.push_back({a_.newLabel(), held_.key()});
    if (!cursor_.code().plan.branch[cursor_.at()]) return;
    if (cursor_.plan(cursor_->a).fused) return test_kind(cursor_->a);
    masks_.set_if_any(cursor_->a);
    a_.jz(ifs_.back().end);
}

// A branch on a record's int that is compared nowhere else.
void ControlFlow::test_kind(Value condition) {
    bool negated = cursor_.inst(condition).op == Op::MNot;
    if (negated) condition = cursor_.inst(condition).a;
    const Inst& equal = cursor_.inst(condition);
    const Inst& read = cursor_.inst(equal.a);
    records_.find(read.a, read.b, true);
    ifs_.back().record = held_.key();  // what it found is known on both ways
    a_.cmp(x86::dword_ptr(x86::r11, 4 * read.imm), cursor_.inst(equal.b).imm);
    negated ? a_.je(ifs_.back().end) : a_.jne(ifs_.back().end);
}

void ControlFlow::op_EndIf() {
    joins_.end_merges();
    const OpenIf& open = ifs_.back();
    a_.bind(open.end);
    if (!held_.is(open.record) && !planted(PlantedFault::RecordKeptAtJoin)) held_.drop();
    ifs_.pop_back();
    joins_.fill_merges();
}

// Sets the flags for begin_body; copying the first values of variables in between leaves them.
void ControlFlow::op_Loop() {
    Value loop = cursor_.at();
    loops_.open(loop);
    assignments_.enter_loop(loop);
    if (cursor_.code().structure.header_of[loop] == loop) begin_body(loop);
}

void ControlFlow::op_LoopVar() {
    Value variable = cursor_.at();
    auto loop = static_cast<Value>(cursor_->imm);
    if (cursor_.code().plan.counted[loop] != variable) assignments_.copy(variable, cursor_->a);
    if (cursor_.code().structure.header_of[loop] == variable) begin_body(loop);
}

void ControlFlow::begin_body(Value loop) {
    held_.drop();
    a_.jz(loops_.innermost().exit);
    for (auto [owner, constant] : cursor_.code().allocation.loop_hoists)
        if (owner == loop) operands_.load_constant(constant);
    loops_.set_counter();
    a_.bind(loops_.innermost().header);
}

void ControlFlow::op_EndLoop() {
    auto begin = static_cast<Value>(cursor_->imm);
    const OpenLoop& loop = loops_.innermost();
    joins_.update_variables(begin, [&] { update_mask(begin); });
    bool known = cursor_.code().plan.rounds[begin] > 0;
    if (!known) leave_unless_any(loop);
    loops_.count_down();
    a_.jnz(loop.header);
    loops_.begin_next_slice();
    if (!known) faults_.report(cursor_.inst(begin).imm);
    a_.bind(loop.exit);
    held_.drop();
    joins_.fill_variables(begin);
    loops_.close();
}

// Leaves flags for leave_unless_any, unless that counts.
void ControlFlow::update_mask(Value loop) {
    const FunctionPlan& plan = cursor_.code().plan;
    if (plan.counted[loop] == kNone && plan.rounds[loop] == 0)
        assignments_.update_loop_mask(loop, cursor_.root(cursor_->a));
}

// Records are counted: the next index against the set's count.
void ControlFlow::leave_unless_any(const OpenLoop& loop) {
    if (cursor_.code().plan.counted[loop.begin] == kNone) return void(a_.jz(loop.exit));
    const Inst& count = cursor_.inst(cursor_.inst(cursor_->a).b);
    int32_t set = cursor_.inst(count.a).imm * static_cast<int32_t>(sizeof(RecordSet));
    loops_.counted_index(x86::eax, loop, 1);
    a_.mov(x86::rdx, x86::ptr(x86::rbx, offsetof(KernelArgs, record_sets)));
    a_.cmp(x86::eax, x86::ptr(x86::rdx, set + static_cast<int32_t>(offsetof(RecordSet, count))));
    a_.jge(loop.exit);
}

}  // namespace kinora::jit::x64
