// jit/codegen/regalloc_check.cpp: proves an allocation by walking it: who lies where, along every
// edge.
#include <fmt/format.h>

#include "jit/codegen/regalloc.h"

namespace kinora::jit {

namespace {

// Which value each register and spill slot holds; kNone: unknown.
struct Contents {
    std::vector<Value> registers[kRegClasses];
    std::vector<Value> slots[kRegClasses];

    // What holds on both edges.
    bool meet(const Contents& other) {
        bool changed = false;
        for (int c = 0; c < kRegClasses; ++c) {
            changed |= meet(registers[c], other.registers[c]);
            changed |= meet(slots[c], other.slots[c]);
        }
        return changed;
    }
    static bool meet(std::vector<Value>& a, const std::vector<Value>& b) {
        bool changed = false;
        for (size_t k = 0; k < a.size(); ++k)
            if (a[k] != b[k] && a[k] != kNone) {
                a[k] = kNone;
                changed = true;
            }
        return changed;
    }
};

class Checker {
  public:
    Checker(const Function& f, const Structure& s, std::span<const ValuePlan> plan,
            const Allocation& allocation)
        : f_(f), s_(s), plan_(plan), al_(allocation) {
        for (int c = 0; c < kRegClasses; ++c) {
            now_.registers[c].assign(64, kNone);
            now_.slots[c].assign(static_cast<size_t>(al_.slots[c]), kNone);
        }
    }

    std::string run() {
        for (Value v : al_.function_hoists) now_.registers[0][reg(v)] = v;
        walk(0, static_cast<Value>(f_.insts.size()));
        return error_;
    }

  private:
    size_t reg(Value v) const { return static_cast<size_t>(al_.intervals[v].reg); }
    size_t cls(Value v) const {
        return plan_[v].cls == RegClass::None ? 0 : static_cast<size_t>(plan_[v].cls) - 1;
    }

    void fail(Value at, Value v, const char* what) {
        if (error_.empty())
            error_ = fmt::format("{}: at %{} {}: %{} {}", f_.name, at,
                                 op_info(f_.insts[at].op).name, v, what);
    }

    void read(Value at, Value v) {
        const LiveInterval& p = al_.intervals[v];
        if (p.in_reg(at)) {
            if (now_.registers[cls(v)][reg(v)] != v) fail(at, v, "is not in its register");
        } else if (plan_[v].cls == RegClass::None || plan_[v].home) {
            return;
        } else if (p.slot < 0) {
            fail(at, v, "has neither register nor memory");
        } else if (now_.slots[cls(v)][static_cast<size_t>(p.slot)] != v) {
            fail(at, v, "is not in its slot");
        }
    }

    void put(Value at, Value v, bool slot_too = true) {
        if (plan_[v].cls == RegClass::None || plan_[v].fused) return;
        const LiveInterval& p = al_.intervals[v];
        if (p.in_reg(at)) now_.registers[cls(v)][reg(v)] = v;
        if (p.slot >= 0 && (slot_too || p.reg < 0))
            now_.slots[cls(v)][static_cast<size_t>(p.slot)] = v;
    }

    void walk(Value at, Value end) {
        while (at < end && error_.empty()) at = step(at);
    }

    // Checks the instruction (a whole If or Loop at its head); returns where to go on.
    Value step(Value at) {
        for (Value v = al_.load_at[at]; v != kNone; v = al_.load_next[v]) put(at, v);
        const Inst& inst = f_.insts[at];
        if (inst.op == Op::If) return step_if(at);
        if (inst.op == Op::Loop) return step_loop(at);
        if (inst.op == Op::Merge || inst.op == Op::LoopOut) return at + 1;
        for_each_use(f_, s_, plan_, at, [&](Value v) { read(at, v); });
        if (plan_[at].clobber)
            for (auto& registers : now_.registers) registers.assign(registers.size(), kNone);
        if (!plan_[at].home && inst.type != Type::None) put(at, at);
        return at + 1;
    }

    Value step_if(Value at) {
        read_operand(at, f_.insts[at].a);
        Value end = s_.end_of[at];
        // Copies run in order; a Merge may take the register of its own outer value only.
        for (Value m = end + 1; f_.insts[m].op == Op::Merge; ++m) {
            read_operand(at, f_.insts[m].b);
            for (Value later = m + 1; f_.insts[later].op == Op::Merge; ++later)
                if (f_.insts[later].b != f_.insts[m].b && share_register(m, f_.insts[later].b, at))
                    fail(at, m, "overwrites an outer value still to be copied");
        }
        for (Value m = end + 1; f_.insts[m].op == Op::Merge; ++m)
            if (!stays(m)) put(at, m, false);
        Contents skipped = now_;
        walk(at + 1, end);
        for_each_use(f_, s_, plan_, end, [&](Value v) { read(end, v); });
        Value m = end + 1;
        for (; f_.insts[m].op == Op::Merge; ++m)
            if (plan_[m].cls != RegClass::None) read_whole(end, m, stays(m) ? lies_there(m) : m);
        now_.meet(skipped);
        for (m = end + 1; f_.insts[m].op == Op::Merge; ++m)
            if (stays(m)) put(end, m);
        for (m = end + 1; f_.insts[m].op == Op::Merge; ++m) store_slot(m);
        return m;
    }

    Value step_loop(Value at) {
        read_operand(at, f_.insts[at].a);
        put(at, at);
        Value header = s_.header_of[at];
        for (Value v = at + 1; v <= header; ++v) {
            for (Value in = al_.load_at[v]; in != kNone; in = al_.load_next[in]) put(v, in);
            read_operand(v, f_.insts[v].a);
            put(v, v, false);
        }
        Contents skipped = now_;
        for (auto [loop, v] : al_.loop_hoists)
            if (loop == at) now_.registers[0][reg(v)] = v;
        Value end = s_.end_of[at];
        for (bool again = true; again && error_.empty();) {
            Contents entry = now_;
            walk(header + 1, end);
            for_each_use(f_, s_, plan_, end, [&](Value v) {
                if (!replaced(at, v)) read(end, v);
            });
            for (Value v = at + 1; v <= header; ++v) put(end, v, false);
            Contents exit = now_;
            now_ = entry;
            again = now_.meet(exit);
            if (!again) now_ = exit;
        }
        now_.meet(skipped);
        for (Value v = at + 1; v <= header; ++v) store_slot(v);
        return end + 1;
    }

    // A variable whose next value lies in its register or slot already.
    bool replaced(Value loop, Value v) const {
        if (v <= loop || v > s_.header_of[loop]) return false;
        Value next = f_.args_of(f_.insts[s_.end_of[loop]])[v - loop - 1];
        return plan_[next].alias == v;
    }

    bool share_register(Value a, Value b, Value at) const {
        return al_.intervals[a].in_reg(at) && al_.intervals[b].in_reg(at) && cls(a) == cls(b) &&
               reg(a) == reg(b);
    }

    void read_operand(Value at, Value v) {
        if (f_.insts[v].op == Op::LoopOut) v = f_.insts[v].a;
        if (!plan_[v].fused) return read(at, v);
        const Inst& inst = f_.insts[v];
        const Value operands[] = {inst.a, inst.b, inst.c};
        for (int k = 0; k < op_info(inst.op).operand_count; ++k) read_operand(at, operands[k]);
    }

    // Its outer value is the variable whose register or slot it shares: nothing is copied at the
    // If.
    bool stays(Value m) const { return plan_[m].alias != kNone && plan_[m].alias == f_.insts[m].b; }

    // What the register or slot of such a Merge holds when its If ends: the arm if it was made
    // there.
    Value lies_there(Value m) const {
        Value arm = f_.insts[m].a;
        return plan_[arm].alias == plan_[m].alias ? arm : plan_[m].alias;
    }

    // A Merge's register or slot was filled at the If and must be untouched at the end.
    void read_whole(Value at, Value m, Value wanted) {
        const LiveInterval& p = al_.intervals[m];
        if (p.reg >= 0 ? now_.registers[cls(m)][reg(m)] != wanted
                       : p.slot >= 0 && now_.slots[cls(m)][static_cast<size_t>(p.slot)] != wanted)
            fail(at, m, "was overwritten inside its if");
    }

    // Values written at several points reach their slot when the last one is done.
    void store_slot(Value v) {
        const LiveInterval& p = al_.intervals[v];
        if (p.slot >= 0) now_.slots[cls(v)][static_cast<size_t>(p.slot)] = v;
    }

    const Function& f_;
    const Structure& s_;
    std::span<const ValuePlan> plan_;
    const Allocation& al_;
    Contents now_;
    std::string error_;
};

}  // namespace

std::string check_allocation(const Function& function, const Structure& structure,
                             std::span<const ValuePlan> plan, const Allocation& allocation) {
    return Checker(function, structure, plan, allocation).run();
}

}  // namespace kinora::jit
