// jit/a64/control.cpp: If and Loop. A region is entered when any lane runs it; what lanes see
// differently is blended under the mask, unless all lanes agree.
#include <cstddef>
#include <iterator>

#include "jit/a64/emit_p.h"

namespace kinora::jit::a64 {

namespace {

// Registers that count iterations, by depth of the loop; deeper ones count in memory.
constexpr Gp kCounters[] = {arm::w10, arm::w11, arm::w12, arm::w13};

}  // namespace

void Emit::branch_if_zero(const Gp& condition, const Label& to) {
    if (!far_branches_) return void(a_.cbz(condition, to));
    Label on = a_.newLabel();
    a_.cbnz(condition, on);
    a_.b(to);
    a_.bind(on);
}

void Emit::branch_if_not_zero(const Gp& condition, const Label& to) {
    if (!far_branches_) return void(a_.cbnz(condition, to));
    Label on = a_.newLabel();
    a_.cbz(condition, on);
    a_.b(to);
    a_.bind(on);
}

void Emit::op_If() {
    Value end = structure_.end_of[at_];
    for (Value m = end + 1; inst(m).op == Op::Merge; ++m) copy(m, inst(m).b);
    ifs_.push_back({a_.newLabel(), record_set_, record_});
    if (!plan_.branch[at_]) return;
    find_any(reg(now().a, 1));
    branch_if_zero(kAny, ifs_.back().end);
}

void Emit::op_EndIf() {
    auto begin = static_cast<Value>(now().imm);
    Value mask = inst(begin).a;
    for (Value m = at_ + 1; inst(m).op == Op::Merge; ++m) {
        if (plan_.values[begin].masked && !planted(PlantedFault::MergeIgnoresMask))
            merge_into(m, inst(m).a, mask);
        else
            copy(m, inst(m).a);
    }
    const OpenIf& open = ifs_.back();
    a_.bind(open.end);
    bool another = record_set_ != open.record_set || record_ != open.record;
    if (another && !planted(PlantedFault::RecordKeptAtJoin)) record_ = kNone;
    ifs_.pop_back();
    for (Value m = at_ + 1; inst(m).op == Op::Merge; ++m) fill_slot(m);
}

// A value written in several places reaches its slot when the last write is done.
void Emit::fill_slot(Value v) {
    if (place(v).reg >= 0) store_slot(v, vec(place(v).reg));
}

// Leaves kAny for begin_body; copying the first values of variables in between keeps it.
void Emit::op_Loop() {
    OpenLoop loop{at_, a_.newLabel(), a_.newLabel(), {}};
    bool kept = !plan_.calls || planted(PlantedFault::CountersAcrossCalls);
    if (kept && loops_.size() < std::size(kCounters)) loop.counter = kCounters[loops_.size()];
    loops_.push_back(loop);
    if (!plan_.values[at_].masked) {
        find_any(reg(now().a, 1));
    } else {
        // Padding lanes never loop: what services left in them may be anything.
        Vec to = target();
        Vec entering = reg(now().a, 1);
        a_.ldr(scratch(2), arm::ptr(kGlobals, kValidVector));
        a_.and_(to.b16(), entering.b16(), scratch(2).b16());
        finish(to);
        find_any(to);
    }
    if (structure_.header_of[at_] == at_) begin_body(at_);
}

void Emit::op_LoopVar() {
    auto begin = static_cast<Value>(now().imm);
    copy(at_, now().a);
    if (structure_.header_of[begin] == at_) begin_body(begin);
}

void Emit::begin_body(Value begin) {
    const OpenLoop& loop = loops_.back();
    record_ = kNone;
    branch_if_zero(kAny, loop.exit);
    for (auto [owner, v] : allocation_.loop_hoists)
        if (owner == begin) load_home(vec(place(v).reg), v);
    Gp budget = loop.counter.isValid() ? loop.counter : arm::w16;
    a_.mov(budget, module_.loop_budget + planted(PlantedFault::LoopBudgetOffByOne));
    if (!loop.counter.isValid()) a_.str(budget, at(kStack, counter(), 4));
    a_.bind(loop.header);
}

int32_t Emit::counter() const {
    return layout_.counters + 4 * static_cast<int32_t>(loops_.size() - 1);
}

// Back to the loop's head while its budget lasts.
void Emit::count_down(const OpenLoop& loop) {
    Gp left = loop.counter.isValid() ? loop.counter : arm::w16;
    if (!loop.counter.isValid()) a_.ldr(left, at(kStack, counter(), 4));
    a_.sub(left, left, 1);
    if (!loop.counter.isValid()) a_.str(left, at(kStack, counter(), 4));
    branch_if_not_zero(left, loop.header);
}

void Emit::report_fault(int32_t site) {
    a_.ldr(arm::x16, arm::ptr(kArgs, offsetof(KernelArgs, fault)));
    a_.mov(arm::w0, 1);
    a_.strb(arm::w0, at(arm::x16, site, 1));
}

void Emit::op_EndLoop() {
    auto begin = static_cast<Value>(now().imm);
    const OpenLoop& loop = loops_.back();
    update_variables(begin);
    branch_if_zero(kAny, loop.exit);
    count_down(loop);
    report_fault(inst(begin).imm);
    a_.bind(loop.exit);
    record_ = kNone;
    for (Value v = begin + 1; v <= structure_.header_of[begin]; ++v) fill_slot(v);
    loops_.pop_back();
}

void Emit::update_variables(Value loop) {
    for (const LoopUpdate& step : loop_updates(loop)) {
        if (step.next == kNone)
            save(step.swap_row, step.variable);
        else if (plan_.values[loop].masked)
            merge_into(step.variable, step.next, loop);
        else
            copy(step.variable, step.next);
    }
    update_mask(loop, root(now().a));
    saved_[0] = saved_[1] = kNone;
}

// Keeps the old value of a variable in swap row k, where reads of it go until the loop's end.
void Emit::save(int k, Value variable) {
    Vec old = reg(variable, 0);
    a_.str(old, row(layout_.swap + kRow * k));
    saved_[k] = variable;
}

// Leaves kAny for the branch back.
void Emit::update_mask(Value loop, Value next_mask) {
    if (!plan_.values[loop].masked) return find_any(reg(next_mask, 1));
    bool memory = place(loop).reg < 0;
    Vec to = memory ? scratch(0) : vec(place(loop).reg);
    Value kept = planted(PlantedFault::LoopMaskNotKept) ? next_mask : loop;
    Vec old = reg(kept, 1), more = reg(next_mask, 2);
    a_.and_(to.b16(), old.b16(), more.b16());
    if (memory) store_slot(loop, to);
    find_any(to);
}

}  // namespace kinora::jit::a64
