// jit/passes/cse.cpp: equal pure values and calls are computed once, loop-invariant values before
// their loop.
//
// Two walks. The first gives each value a leader (the first equal one that is visible) and a home:
// the region in which it can stand, which is outside of every loop that it does not depend on. The
// second writes the function with leaders only, each in its home. Nothing is moved out of an If
// unless it also leaves a loop.
#include <algorithm>
#include <bit>

#include "jit/ir/analysis.h"
#include "jit/ir/planted_fault.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

bool is_leaf(Op op) {
    return op == Op::ConstF || op == Op::ConstI || op == Op::ConstM || op == Op::Input ||
           op == Op::FrameLoad;
}

uint32_t hash(const Inst& inst, uint32_t epoch) {
    uint64_t h = static_cast<uint64_t>(inst.op) << 32 | static_cast<uint32_t>(inst.imm);
    auto mix = [&](uint64_t word) { h = (std::rotl(h, 23) ^ word) * 0x9e3779b97f4a7c15u; };
    mix(static_cast<uint64_t>(inst.a) << 32 | inst.b);
    mix(static_cast<uint64_t>(inst.c) << 32 | epoch);
    mix(static_cast<uint64_t>(inst.type) << 32 | static_cast<uint32_t>(inst.imm2));
    return static_cast<uint32_t>(h >> 32);
}

class CommonValues {
  public:
    CommonValues(const Module& module, Function& function, const std::vector<bool>& effects)
        : m_(module), effects_(effects), r_(function) {
        size_t count = r_.old.size();
        leader_.resize(count);
        home_.assign(count, 0);
        keys_.resize(count);
        epochs_.assign(count, 0);
        table_.assign(std::bit_ceil(count * 2 + 2), kNone);
        first_before_.assign(count, kNone);
        last_before_.assign(count, kNone);
        next_before_.assign(count, kNone);
        regions_.push_back({kNone, 0, 0, true});
        find_writing_loops();
    }

    void run() {
        for (Value v = 0; v < r_.old.size(); ++v) lead(v);
        write();
    }

  private:
    // Region 0 is the function; others an If or a Loop.
    struct Region {
        Value begin;
        uint32_t parent;
        uint32_t depth;
        bool open;
    };

    // What a loop's body writes is seen by the body's next round.
    void find_writing_loops() {
        writes_.assign(r_.old.size(), false);
        std::vector<Value> around;
        for (Value v = 0; v < r_.old.size(); ++v) {
            const Inst& inst = r_.old[v];
            bool call = inst.op == Op::Call || inst.op == Op::Service;
            if (inst.op == Op::Loop) around.push_back(v);
            if (inst.op == Op::EndLoop) around.pop_back();
            if (inst.op == Op::ArrayStore || (call && !is_effect_free(inst)))
                for (Value loop : around) writes_[loop] = !planted(PlantedFault::CseAcrossTurns);
        }
    }

    void lead(Value v) {
        const Inst& inst = r_.old[v];
        leader_[v] = v;
        home_[v] = current_;
        if (inst.op == Op::If || inst.op == Op::Loop) {
            open_region(v);
            if (inst.op == Op::Loop) home_[v] = current_;
        } else if (inst.op == Op::EndIf || inst.op == Op::EndLoop) {
            close_region();
        } else if (is_pure(inst.op) || (op_info(inst.op).flags & kRead)) {
            lead_value(v);
        } else if (inst.op == Op::Call || inst.op == Op::Service) {
            is_effect_free(inst) ? lead_call(v) : void(++epoch_);
        } else if (inst.op == Op::Result) {
            leader_[v] = leader_[inst.a] + (v - inst.a);
        } else if (inst.op == Op::ArrayStore && !planted(PlantedFault::CseAcrossStore)) {
            ++epoch_;
        }
    }

    bool is_effect_free(const Inst& inst) const {
        auto index = static_cast<size_t>(inst.imm);
        if (planted(PlantedFault::EffectMerged)) return true;
        return inst.op == Op::Call ? !effects_[index] : m_.services[index].pure;
    }

    // Calls are merged where they stand, never moved: a mask may keep them from running.
    void lead_call(Value v) {
        Inst& key = keys_[v] = r_.old[v];
        key.a = leader_[key.a];
        key.args = static_cast<uint32_t>(call_args_.size());
        for (Value arg : r_.old_args_of(r_.old[v])) call_args_.push_back(leader_[arg]);
        key.imm2 = 0;
        for (size_t k = key.args; k < call_args_.size(); ++k)
            key.imm2 = static_cast<int32_t>(static_cast<uint32_t>(key.imm2) * 31 + call_args_[k]);
        epochs_[v] = epoch_;
        if (Value found = find_or_insert(v); found != kNone) leader_[v] = found;
    }

    void open_region(Value v) {
        regions_.push_back({v, current_, regions_[current_].depth + 1, true});
        current_ = static_cast<uint32_t>(regions_.size() - 1);
        if (writes_[v]) ++epoch_;
    }

    void close_region() {
        if (writes_[regions_[current_].begin]) ++epoch_;
        regions_[current_].open = false;
        current_ = regions_[current_].parent;
    }

    void lead_value(Value v) {
        Inst key = r_.old[v];
        if (key.a != kNone) key.a = leader_[key.a];
        if (key.b != kNone) key.b = leader_[key.b];
        if (key.c != kNone) key.c = leader_[key.c];
        bool commutes = (op_info(key.op).flags & kCommutative) != 0;
        if (commutes && key.a > key.b) std::swap(key.a, key.b);
        keys_[v] = key;
        bool reads = (op_info(key.op).flags & kRead) != 0;
        epochs_[v] = reads ? epoch_ : 0;
        if (Value found = find_or_insert(v); found != kNone) {
            leader_[v] = found;
            return;
        }
        if (reads) return;
        home_[v] = is_leaf(key.op) ? 0 : home_of(key);
        if (home_[v] != current_) move_before(v, loop_to_leave(home_[v]));
    }

    // An equal earlier value that is visible here; else v replaces it in the table.
    Value find_or_insert(Value v) {
        size_t mask = table_.size() - 1;
        for (size_t at = hash(keys_[v], epochs_[v]) & mask;; at = (at + 1) & mask) {
            Value other = table_[at];
            if (other == kNone) {
                table_[at] = v;
                return kNone;
            }
            if (epochs_[other] != epochs_[v] || !equal(keys_[other], keys_[v])) continue;
            if (regions_[home_[other]].open) return other;
            table_[at] = v;
            return kNone;
        }
    }

    bool equal(const Inst& x, const Inst& y) const {
        bool same = x.op == y.op && x.type == y.type && x.a == y.a && x.b == y.b && x.c == y.c &&
                    x.imm == y.imm && x.imm2 == y.imm2;
        auto args = call_args_.begin();
        return same && (x.arg_count == 0 ||
                        std::equal(args + x.args, args + x.args + x.arg_count, args + y.args));
    }

    // The outermost region that sees all operands, if a loop lies between it and here.
    uint32_t home_of(const Inst& key) const {
        uint32_t deepest = 0;
        for (Value operand : {key.a, key.b, key.c})
            if (operand != kNone && regions_[home_[operand]].depth > regions_[deepest].depth)
                deepest = home_[operand];
        // Walk outwards; each loop passed on the way moves the home to outside of it.
        uint32_t home = current_;
        for (uint32_t region = current_; region != deepest; region = regions_[region].parent)
            if (r_.old[regions_[region].begin].op == Op::Loop) home = regions_[region].parent;
        return home;
    }

    // The loop, child of `home`'s scope on the way here, before which a value of that home stands.
    Value loop_to_leave(uint32_t home) const {
        uint32_t region = current_;
        while (regions_[region].parent != home) region = regions_[region].parent;
        return regions_[region].begin;
    }

    void move_before(Value v, Value at) {
        if (is_leaf(r_.old[v].op)) return;
        (first_before_[at] == kNone ? first_before_[at] : next_before_[last_before_[at]]) = v;
        last_before_[at] = v;
    }

    void write() {
        moved_.assign(r_.old.size(), false);
        mark_moved();
        for (Value v = 0; v < r_.old.size(); ++v)
            if (r_.old[v].op == Op::Param) r_.copy(v);
        for (Value v = 0; v < r_.old.size(); ++v)
            if (leader_[v] == v && is_leaf(r_.old[v].op)) r_.copy(v);
        for (Value v = 0; v < r_.old.size(); ++v) {
            for (Value k = first_before_[v]; k != kNone; k = next_before_[k]) copy_leader(k);
            bool done = r_.old[v].op == Op::Param || is_leaf(r_.old[v].op) || moved_[v];
            if (done || leader_[v] != v)
                r_.renamed[v] = r_.renamed[leader_[v]];
            else
                copy_leader(v);
        }
    }

    void mark_moved() {
        for (Value at = 0; at < r_.old.size(); ++at)
            for (Value k = first_before_[at]; k != kNone; k = next_before_[k]) moved_[k] = true;
    }

    // Operands may name values whose leaders moved ahead of them.
    void copy_leader(Value v) {
        for (Value operand : {r_.old[v].a, r_.old[v].b, r_.old[v].c})
            if (operand != kNone && r_.renamed[operand] == kNone)
                r_.renamed[operand] = r_.renamed[leader_[operand]];
        r_.copy(v);
    }

    const Module& m_;
    const std::vector<bool>& effects_;
    Rewrite r_;
    std::vector<Value> call_args_;  // leaders of the arguments of calls seen
    std::vector<Value> leader_;
    std::vector<uint32_t> home_;
    std::vector<Inst> keys_;
    std::vector<uint32_t> epochs_;
    std::vector<Value> table_;  // open addressing
    std::vector<Value> first_before_, last_before_, next_before_;
    std::vector<bool> moved_;
    std::vector<bool> writes_;  // Loops around a store or a call with effects
    std::vector<Region> regions_;
    uint32_t current_ = 0;
    uint32_t epoch_ = 0;
};

}  // namespace

void cse(Module& module) {
    std::vector<bool> effects = has_effects(module);
    for (Function& function : module.functions) CommonValues(module, function, effects).run();
}

}  // namespace kinora::jit
