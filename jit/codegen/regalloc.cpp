// jit/codegen/regalloc.cpp: linear-scan register allocation over the structured IR.
#include "jit/codegen/regalloc.h"
#include "jit/ir/planted_fault.h"

#include <algorithm>
#include <bit>

#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

constexpr uint32_t kForever = ~0u;

class Allocator {
  public:
    Allocator(const Function& f, const Structure& s, std::span<const ValuePlan> plan,
              const AllocationLimits& limits)
        : f_(f), s_(s), plan_(plan), limits_(limits), n_(static_cast<Value>(f.insts.size())) {
        out_.intervals.resize(n_);
        for (int c = 0; c < kRegClasses; ++c) {
            all_[c] = ((1ull << limits.registers[c]) - 1) & ~((1ull << limits.first[c]) - 1);
            free_[c] = all_[c];
        }
    }

    Allocation run() {
        find_ranges();
        delay_late_loads();
        scan();
        hoist_over_function();
        assign_slots();
        for (Value v = 0; v < n_; ++v)
            if (plan_[v].alias != kNone) interval(v) = interval(plan_[v].alias);
        return std::move(out_);
    }

  private:
    LiveInterval& interval(Value v) { return out_.intervals[v]; }
    int cls(Value v) const { return static_cast<int>(plan_[v].cls) - 1; }
    bool wants_register(Value v) const {
        return plan_[v].cls != RegClass::None && !plan_[v].fused && plan_[v].alias == kNone &&
               f_.insts[v].op != Op::LoopOut;
    }
    template <class Use>
    void uses(Value at, Use&& use) {
        for_each_use(f_, s_, plan_, at,
                     [&](Value v) { use(plan_[v].alias == kNone ? v : plan_[v].alias); });
    }

    // The outermost loop whose body holds `at` but not the definition at `begin`, or kNone.
    Value loop_between(Value begin, Value at) const {
        Value found = kNone;
        for (Value loop = s_.loop_of[at]; loop != kNone && s_.header_of[loop] >= begin;
             loop = s_.loop_of[loop])
            found = loop;
        return found;
    }

    void find_ranges() {
        for (Value v = 0; v < n_; ++v) interval(v).begin = interval(v).end = v;
        for (Value v = 0; v < n_; ++v) {
            const Inst& inst = f_.insts[v];
            if (inst.op == Op::Merge) interval(v).begin = static_cast<Value>(inst.imm);
            if (plan_[v].home) interval(v).begin = 0;  // loaded before any loop around its uses
        }
        first_use_.assign(n_, kNone);
        // Backward, so the first use met is the last one; earlier ones only move first_use_.
        for (Value at = n_; at-- > 0;) {
            uses(at, [&](Value v) {
                LiveInterval& p = interval(v);
                if (first_use_[v] == kNone) {
                    Value loop = loop_between(p.begin, at);
                    if (planted(PlantedFault::RangeNotStretched)) loop = kNone;
                    p.end = std::max(p.end, loop == kNone ? at : s_.end_of[loop]);
                }
                first_use_[v] = at;
                if (plan_[v].hoist) weigh(v, at);
            });
        }
    }

    // Inputs stand first in a function; they are loaded before their first use, outside any If or
    // Loop, so that they do not hold registers before it.
    void delay_late_loads() {
        out_.load_at.assign(n_, kNone);
        out_.load_next.assign(n_, kNone);
        for (Value v = 0; v < n_; ++v) {
            if (!plan_[v].home || !wants_register(v) || first_use_[v] == kNone) continue;
            Value at = s_.top[first_use_[v]];
            interval(v).begin = at;
            out_.load_next[v] = out_.load_at[at];
            out_.load_at[at] = v;
        }
    }

    void scan() {
        for (Value at = 0; at < n_; ++at) {
            for (Value v = out_.load_at[at]; v != kNone; v = out_.load_next[v])
                give_register(v, at, at - 1);
            const Inst& inst = f_.insts[at];
            if (inst.op == Op::If) start_merges(at);
            release_operands(at);
            if (inst.op == Op::EndIf || inst.op == Op::EndLoop) release_ended(at);
            if (plan_[at].clobber) spill_all(at);
            if (inst.op != Op::Merge && wants_register(at) && !plan_[at].home) {
                if (inst.op == Op::LoopVar) take_over(at, inst.a, at);
                if (interval(at).reg < 0) give_register(at, at, at);
                if (interval(at).end == at) release(at);
            }
            track_loops(at);
        }
    }

    void release(Value v) {
        LiveInterval& p = interval(v);
        if (!wants_register(v) || p.reg < 0 || occupant_[cls(v)][p.reg] != v) return;
        occupant_[cls(v)][p.reg] = kNone;
        free_[cls(v)] |= 1ull << p.reg;
    }

    void release_operands(Value at) {
        uses(at, [&](Value v) {
            if (interval(v).end == at) release(v);
        });
    }

    // Ranges stretched to the end of a loop end without being read there.
    void release_ended(Value at) {
        for (int c = 0; c < kRegClasses; ++c)
            for (uint64_t held = all_[c] & ~free_[c]; held; held &= held - 1) {
                Value v = occupant_[c][std::countr_zero(held)];
                if (interval(v).end <= at) release(v);
            }
    }

    // The register of `from`, if it dies here, becomes the register of `to`.
    void take_over(Value to, Value from, Value at) {
        if (f_.insts[from].op == Op::LoopOut) from = f_.insts[from].a;
        bool dies = interval(from).end == at || planted(PlantedFault::MergeTakesLiveRegister);
        if (plan_[from].fused || plan_[from].cls != plan_[to].cls || !dies) return;
        LiveInterval& p = interval(from);
        if (!p.in_reg(at) || p.reg < 0) return;
        Value holder = occupant_[cls(to)][p.reg];
        bool just_freed = holder == kNone && (free_[cls(to)] >> p.reg & 1);
        if (holder != from && !just_freed) return;
        occupy(to, p.reg);
    }

    // Merges live from their If: each starts as its outer value. A register of a dying outer value
    // goes to its own Merge only, so these copies never overlap.
    void start_merges(Value at) {
        for (Value m = s_.end_of[at] + 1; f_.insts[m].op == Op::Merge; ++m)
            if (wants_register(m)) take_over(m, f_.insts[m].b, at);
        for (Value m = s_.end_of[at] + 1; f_.insts[m].op == Op::Merge; ++m)
            if (wants_register(m) && interval(m).reg < 0) give_register(m, at, at - 1);
    }

    void occupy(Value v, int reg) {
        int c = cls(v);
        free_[c] &= ~(1ull << reg);
        touched_[c] |= 1ull << reg;
        loop_touched_[c] |= 1ull << reg;
        occupant_[c][reg] = v;
        interval(v).reg = static_cast<int8_t>(reg);
        interval(v).reg_last = kForever;
    }

    // A free register for v, or that of the value ending last. An evicted value may be read from
    // its register at positions <= `last`.
    void give_register(Value v, Value at, Value last) {
        int c = cls(v);
        if (free_[c] != 0) return occupy(v, preferred(v, at));
        Value victim = v;
        uint32_t end = effective_end(v, at);
        for (uint64_t held = all_[c]; held; held &= held - 1) {
            Value held_by = occupant_[c][std::countr_zero(held)];
            uint32_t held_end = effective_end(held_by, at);
            if (held_end > end) {
                victim = held_by;
                end = held_end;
            }
        }
        if (victim == v) return;
        int reg = interval(victim).reg;
        evict(victim, at, last);
        occupy(v, reg);
    }

    // A dying operand's register lets Fma and Select write over an operand.
    int preferred(Value v, Value at) {
        int c = cls(v);
        const Inst& inst = f_.insts[v];
        const Value operands[] = {inst.c, inst.a, inst.b};
        if (inst.op != Op::Fma && inst.op != Op::Select) return std::countr_zero(free_[c]);
        for (Value from : operands) {
            const LiveInterval& p = interval(from);
            if (plan_[from].cls == plan_[v].cls && p.end == at && p.in_reg(at) &&
                (free_[c] >> p.reg & 1))
                return p.reg;
        }
        return std::countr_zero(free_[c]);
    }

    // Values carried around the innermost loop we are in are its last choice for memory. Those of
    // loops around it wait there for the most part: what it computes itself comes first.
    uint32_t effective_end(Value v, Value at) const {
        const Inst& inst = f_.insts[v];
        if (inst.op == Op::Loop) return at;
        // Merges that start here may sit in registers of outer values still to be copied.
        if (inst.op == Op::Merge && static_cast<Value>(inst.imm) == at) return at;
        if (inst.op == Op::LoopVar && carries_on(static_cast<Value>(inst.imm), at)) return at;
        return out_.intervals[v].end;
    }

    bool carries_on(Value loop, Value at) const {
        bool innermost = s_.loop_of[at] == loop || !s_.in_loop(loop, at);
        return innermost && at <= s_.end_of[loop];
    }

    void evict(Value v, Value at, Value last) {
        LiveInterval& p = interval(v);
        int c = cls(v);
        occupant_[c][p.reg] = kNone;
        free_[c] |= 1ull << p.reg;
        if (rewritten_after(v, at)) {
            p.reg = -1;  // it must lie in one or the other wherever it is written
            return;
        }
        Value loop = loop_between(p.begin, at);
        int64_t reg_last = loop == kNone ? static_cast<int64_t>(last) : s_.header_of[loop];
        if (reg_last < static_cast<int64_t>(p.begin) || last == kNone) {
            p.reg = -1;
            return;
        }
        p.reg_last = static_cast<uint32_t>(reg_last);
    }

    bool rewritten_after(Value v, Value at) const {
        const Inst& inst = f_.insts[v];
        if (inst.op == Op::Loop) return true;
        if (inst.op != Op::LoopVar && inst.op != Op::Merge) return false;
        return at <= s_.end_of[static_cast<Value>(inst.imm)];
    }

    void spill_all(Value at) {
        for (int c = 0; c < kRegClasses; ++c)
            for (uint64_t held = all_[c] & ~free_[c]; held; held &= held - 1)
                evict(occupant_[c][std::countr_zero(held)], at, at);
        clobbered_ = true;
        loop_clobbered_ = true;
    }

    // --- constants in registers that stay free ---

    void weigh(Value v, Value at) {
        if (weights_.empty()) {
            weights_.assign(n_, 0);
            loop_weights_.assign(n_, {kNone, 0});
        }
        auto weight = static_cast<uint32_t>(1u << (3 * s_.depth[at]));
        weights_[v] += weight;
        if (s_.depth[at] == 0) return;
        // The outermost loop that comes first is the one met last, going backward.
        Value loop = outermost_loop(at);
        auto& [known, sum] = loop_weights_[v];
        if (known != loop) sum = 0;
        known = loop;
        sum += weight;
    }

    Value outermost_loop(Value at) const {
        Value found = s_.loop_of[at];
        while (s_.loop_of[found] != kNone) found = s_.loop_of[found];
        return found;
    }

    void track_loops(Value at) {
        Value loop = s_.depth[at] > 0 ? outermost_loop(at) : kNone;
        if (loop == kNone) {
            loop_clobbered_ = false;
            for (int c = 0; c < kRegClasses; ++c) loop_touched_[c] = all_[c] & ~free_[c];
        } else if (at == s_.end_of[loop] && !loop_clobbered_) {
            loops_.push_back({loop, all_[0] & ~loop_touched_[0]});
        }
    }

    void hoist_to(Value v, uint64_t& free, int64_t after, uint32_t last) {
        LiveInterval& p = interval(v);
        p.reg = static_cast<int8_t>(std::countr_zero(free));
        free &= free - 1;
        p.reg_after = after;
        p.reg_last = last;
    }

    void hoist_over_function() {
        if (weights_.empty()) return;
        std::vector<Value> wanted;
        for (Value v = 0; v < n_; ++v)
            if (plan_[v].hoist && weights_[v] > 0) wanted.push_back(v);
        std::stable_sort(wanted.begin(), wanted.end(),
                         [&](Value a, Value b) { return weights_[a] > weights_[b]; });
        uint64_t free = limits_.hoist_function && !clobbered_ ? all_[0] & ~touched_[0] : 0;
        uint64_t taken = free;
        for (Value v : wanted) {
            if (free == 0) break;
            hoist_to(v, free, -1, kForever);
            out_.function_hoists.push_back(v);
        }
        taken &= ~free;
        for (auto [loop, loop_free] : loops_) hoist_over_loop(loop, loop_free & ~taken, wanted);
    }

    void hoist_over_loop(Value loop, uint64_t free, std::span<const Value> wanted) {
        for (Value v : wanted) {
            if (free == 0) return;
            if (interval(v).reg >= 0 || loop_weights_[v].first != loop) continue;
            hoist_to(v, free, s_.header_of[loop], s_.end_of[loop]);
            out_.loop_hoists.push_back({loop, v});
        }
    }

    // --- spill slots, shared by values whose ranges do not meet ---

    bool needs_slot(Value v) const {
        const LiveInterval& p = out_.intervals[v];
        if (!wants_register(v) || plan_[v].home) return false;
        return p.reg < 0 || p.reg_last < p.end;
    }

    void assign_slots() {
        bool any = false;
        for (Value v = 0; v < n_ && !any; ++v) any = needs_slot(v);
        if (!any) return;
        place_in_slots_.resize(n_);
        for (Value at = 0; at < n_; ++at) {
            const Inst& inst = f_.insts[at];
            // New slots are taken before old ones are freed: a Merge starts while its If reads.
            if (inst.op == Op::If)
                for (Value m = s_.end_of[at] + 1; f_.insts[m].op == Op::Merge; ++m) take_slot(m);
            if (inst.op != Op::Merge) take_slot(at);
            Value ahead = planted(PlantedFault::SlotFreedEarly) ? 4 : 0;
            uses(at, [&](Value v) {
                if (interval(v).end <= at + ahead) free_slot(v);
            });
            if (inst.op == Op::EndLoop || inst.op == Op::EndIf) free_ended(at);
        }
    }

    void take_slot(Value v) {
        if (!needs_slot(v)) return;
        int c = cls(v);
        if (free_slots_[c].empty()) {
            interval(v).slot = out_.slots[c]++;
        } else {
            interval(v).slot = free_slots_[c].back();
            free_slots_[c].pop_back();
        }
        if (interval(v).end <= v) return;
        place_in_slots_[v] = uint32_t(in_slots_.size());
        in_slots_.push_back(v);
    }

    void free_slot(Value v) {
        if (interval(v).slot < 0) return;
        const uint32_t at = place_in_slots_[v];
        if (at >= in_slots_.size() || in_slots_[at] != v) return;  // it is free already
        free_slots_[cls(v)].push_back(interval(v).slot);
        in_slots_[at] = in_slots_.back();
        place_in_slots_[in_slots_[at]] = at;
        in_slots_.pop_back();
    }

    void free_ended(Value at) {
        for (size_t k = in_slots_.size(); k-- > 0;)
            if (interval(in_slots_[k]).end <= at) free_slot(in_slots_[k]);
    }

    const Function& f_;
    const Structure& s_;
    std::span<const ValuePlan> plan_;
    const AllocationLimits& limits_;
    const Value n_;
    Allocation out_;
    std::vector<Value> first_use_;
    uint64_t all_[kRegClasses];
    uint64_t free_[kRegClasses];
    Value occupant_[kRegClasses][64];
    uint64_t touched_[kRegClasses] = {};
    uint64_t loop_touched_[kRegClasses] = {};
    bool clobbered_ = false;
    bool loop_clobbered_ = false;
    std::vector<uint32_t> weights_;
    std::vector<std::pair<Value, uint32_t>> loop_weights_;  // the first outermost loop using it
    std::vector<std::pair<Value, uint64_t>> loops_;         // outermost loops, registers free there
    std::vector<Value> in_slots_;
    std::vector<uint32_t> place_in_slots_;  // by value: where it is in in_slots_, if it is
    std::vector<int32_t> free_slots_[kRegClasses];
};

}  // namespace

Structure::Structure(const Function& function) {
    auto n = static_cast<Value>(function.insts.size());
    end_of.assign(n, kNone);
    header_of.assign(n, kNone);
    top.resize(n);
    depth.assign(n, 0);
    loop_of.assign(n, kNone);
    std::vector<Value> open;
    Value loop = kNone;  // innermost, body begun
    uint8_t level = 0;
    for (Value at = 0; at < n; ++at) {
        const Inst& inst = function.insts[at];
        top[at] = open.empty() ? at : open.front();
        loop_of[at] = loop;
        depth[at] = level;
        if (inst.op == Op::If || inst.op == Op::Loop) open.push_back(at);
        if (inst.op == Op::Loop) {
            Value header = at;
            while (function.insts[header + 1].op == Op::LoopVar) ++header;
            header_of[at] = header;
        }
        if (inst.op == Op::Loop || inst.op == Op::LoopVar) {
            Value begin = inst.op == Op::Loop ? at : static_cast<Value>(inst.imm);
            if (header_of[begin] == at) {
                loop = begin;
                level = static_cast<uint8_t>(std::min(level + 1, 7));
            }
        }
        if (inst.op == Op::EndIf || inst.op == Op::EndLoop) {
            auto begin = static_cast<Value>(inst.imm);
            end_of[begin] = at;
            open.pop_back();
            if (inst.op == Op::EndLoop) {
                loop = loop_of[begin];
                level = depth[begin];
            }
        }
    }
}

Allocation allocate_registers(const Function& function, const Structure& structure,
                              std::span<const ValuePlan> plan, const AllocationLimits& limits) {
    return Allocator(function, structure, plan, limits).run();
}

}  // namespace kinora::jit
