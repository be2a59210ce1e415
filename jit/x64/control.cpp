// jit/x64/control.cpp: If and Loop. A region is entered when any lane runs it; what lanes see
// differently is blended under the mask, unless all lanes agree.
#include "jit/x64/emit_p.h"

namespace kinora::jit::x64 {

namespace {

// Registers that count iterations, by depth of the loop; deeper ones count in memory.
constexpr x86::Gp kCounters[] = {x86::r8d, x86::r9d};

}  // namespace

void Emit::op_If() {
    Value end = structure_.end_of[at_];
    for (Value m = end + 1; inst(m).op == Op::Merge; ++m) copy(m, inst(m).b);
    ifs_.push_back({a_.newLabel(), record_set_, record_});
    if (!plan_.branch[at_]) return;
    if (plan_.values[now().a].fused) return test_kind(now().a);
    set_if_any(now().a);
    a_.jz(ifs_.back().end);
}

// A branch on a record's int that is compared nowhere else.
void Emit::test_kind(Value condition) {
    bool negated = inst(condition).op == Op::MNot;
    if (negated) condition = inst(condition).a;
    const Inst& equal = inst(condition);
    const Inst& read = inst(equal.a);
    find_record(read.a, read.b, true);
    ifs_.back().record_set = record_set_;  // what it found is known on both ways
    ifs_.back().record = record_;
    a_.cmp(x86::dword_ptr(x86::r11, 4 * read.imm), inst(equal.b).imm);
    negated ? a_.je(ifs_.back().end) : a_.jne(ifs_.back().end);
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
    const Place& p = place(v);
    if (p.reg < 0 || p.slot < 0) return;
    if (is_mask(v))
        store_mask_slot(v, x86::k(static_cast<uint32_t>(p.reg)));
    else
        store_slot(v, vec(p.reg));
}

// Sets the flags for begin_body; copying the first values of variables in between leaves them.
void Emit::op_Loop() {
    bool masked = plan_.values[at_].masked;
    OpenLoop loop{at_, a_.newLabel(), a_.newLabel(), {}};
    bool kept = !plan_.calls || planted(PlantedFault::CountersAcrossCalls);
    if (kept && loops_.size() < std::size(kCounters)) loop.counter = kCounters[loops_.size()];
    loops_.push_back(loop);
    if (!masked) {
        set_if_any(now().a);
    } else if (isa_.wide) {
        x86::KReg to = mask_target();
        x86::KReg entering = mask_reg(now().a, 7);
        // Padding lanes never loop: what services left in them may be anything.
        a_.kmovw(x86::k0, x86::ptr(x86::r13, kValidBits));
        a_.kandw(to, entering, x86::k0);
        finish_mask(to);
        a_.kortestw(to, to);
    } else {
        x86::Vec to = target();
        a_.vandps(to, reg(now().a, 1), x86::ptr(x86::r13, kValidVector));
        finish(to);
        a_.vmovmskps(x86::eax, to);
        a_.test(x86::eax, x86::eax);
    }
    if (structure_.header_of[at_] == at_) begin_body(at_);
}

void Emit::op_LoopVar() {
    auto begin = static_cast<Value>(now().imm);
    if (plan_.counted[begin] != at_) copy(at_, now().a);
    if (structure_.header_of[begin] == at_) begin_body(begin);
}

void Emit::begin_body(Value begin) {
    const OpenLoop& loop = loops_.back();
    record_ = kNone;
    a_.jz(loop.exit);
    auto& hoists = allocation_.loop_hoists;
    for (size_t k = 0; k < hoists.size(); ++k)
        if (hoists[k].first == begin) load_constant(hoists[k].second);
    int32_t rounds = plan_.rounds[begin];
    int32_t budget =
        (rounds > 0 ? rounds : module_.loop_budget) + planted(PlantedFault::LoopBudgetOffByOne);
    if (loop.counter.isValid())
        a_.mov(loop.counter, budget);
    else
        a_.mov(counter(), budget);
    a_.bind(loop.header);
}

x86::Mem Emit::counter() const {
    return x86::dword_ptr(x86::r15, layout_.counters + 4 * static_cast<int32_t>(loops_.size() - 1));
}

void Emit::op_EndLoop() {
    auto begin = static_cast<Value>(now().imm);
    const OpenLoop& loop = loops_.back();
    update_variables(begin);
    bool known = plan_.rounds[begin] > 0;
    if (!known) leave(loop);
    if (loop.counter.isValid())
        a_.dec(loop.counter);
    else
        a_.dec(counter());
    a_.jnz(loop.header);
    if (!known) {
        a_.mov(x86::rax, x86::ptr(x86::rbx, offsetof(KernelArgs, fault)));
        a_.mov(x86::byte_ptr(x86::rax, inst(begin).imm), 1);
    }
    a_.bind(loop.exit);
    record_ = kNone;
    for (Value v = begin + 1; v <= structure_.header_of[begin]; ++v) fill_slot(v);
    loops_.pop_back();
}

// If no lane runs on, as flags say; records are counted: the next index against the set's count.
void Emit::leave(const OpenLoop& loop) {
    if (plan_.counted[loop.begin] == kNone) return void(a_.jz(loop.exit));
    const Inst& count = inst(inst(now().a).b);
    int32_t set = inst(count.a).imm * static_cast<int32_t>(sizeof(RecordSet));
    index_in(x86::eax, loop, 1);
    a_.mov(x86::rdx, x86::ptr(x86::rbx, offsetof(KernelArgs, record_sets)));
    a_.cmp(x86::eax, x86::ptr(x86::rdx, set + static_cast<int32_t>(offsetof(RecordSet, count))));
    a_.jge(loop.exit);
}

// What counts the records of a loop, plus `ahead`.
void Emit::index_in(const x86::Gp& to, const OpenLoop& loop, int32_t ahead) {
    int32_t first = inst(inst(plan_.counted[loop.begin]).a).imm;
    a_.mov(to, module_.loop_budget + first + ahead);
    a_.sub(to, loop.counter);
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
    if (plan_.counted[loop] == kNone && plan_.rounds[loop] == 0) update_mask(loop, root(now().a));
    saved_[0] = saved_[1] = kNone;
}

// Keeps the old value of a variable in swap row k, where reads of it go until the loop's end.
void Emit::save(int k, Value variable) {
    if (is_mask(variable))
        a_.kmovw(row(layout_.swap + kRow * k), mask_reg(variable, 7));
    else
        a_.emit(Id::kIdVmovaps, row(layout_.swap + kRow * k), reg(variable, 0));
    saved_[k] = variable;
}

// Leaves the flags for the branch back: not zero if a lane runs on.
void Emit::update_mask(Value loop, Value next_mask) {
    if (!plan_.values[loop].masked) return set_if_any(next_mask);
    bool memory = place(loop).reg < 0;
    if (isa_.wide) {
        x86::KReg to = memory ? x86::k7 : x86::k(static_cast<uint32_t>(place(loop).reg));
        Value kept = planted(PlantedFault::LoopMaskNotKept) ? next_mask : loop;
        a_.kandw(to, mask_reg(kept, 7), mask_reg(next_mask, 0));
        if (memory) store_mask_slot(loop, to);
        a_.kortestw(to, to);
    } else {
        x86::Vec to = memory ? scratch(0) : vec(place(loop).reg);
        x86::Vec old = reg(planted(PlantedFault::LoopMaskNotKept) ? next_mask : loop, 1);
        a_.emit(Id::kIdVandps, to, old, operand(next_mask));
        if (memory) store_slot(loop, to);
        a_.vmovmskps(x86::eax, to);
        a_.test(x86::eax, x86::eax);
    }
}

}  // namespace kinora::jit::x64
