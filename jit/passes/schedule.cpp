// jit/passes/schedule.cpp: what a loop's next round begins with is computed as soon as it can be.
//
// `at *= 2` at the end of a body holds up the round that follows: a machine looks ahead a hundred
// instructions or two, which is one round of noise. So an operation that gives a variable its next
// value moves up to the last other read of the variable, whose register it can take there.
#include <algorithm>

#include "jit/ir/analysis.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

class Scheduler {
  public:
    explicit Scheduler(Function& function) : f_(function) {}

    void run() {
        if (std::none_of(f_.insts.begin(), f_.insts.end(),
                         [](const Inst& inst) { return inst.op == Op::Loop; }))
            return;
        match_ = match_regions(f_);
        find_regions();
        find_readers();
        for (Value v = 0; v < f_.insts.size(); ++v)
            if (f_.insts[v].op == Op::LoopVar) plan(v);
        if (!moves_.empty()) write();
    }

  private:
    struct Move {
        Value behind, what;
    };

    // Of each instruction the If or Loop that it stands in; LoopVars stand in their Loop.
    void find_regions() {
        region_.assign(f_.insts.size(), kNone);
        Value open = kNone;
        for (Value v = 0; v < f_.insts.size(); ++v) {
            Op op = f_.insts[v].op;
            if (op == Op::EndIf || op == Op::EndLoop) open = region_[match_[v]];
            region_[v] = open;
            if (op == Op::If || op == Op::Loop) open = v;
        }
    }

    // Of LoopVars: the last read but by what computes the next value; by the loop's end: kNone.
    void find_readers() {
        last_read_.assign(f_.insts.size(), 0);
        auto read = [&](Value v, Value by) {
            if (v == kNone || f_.insts[v].op != Op::LoopVar || f_.insts[by].op == Op::LoopOut)
                return;
            if (by == next_of(v)) return;
            auto loop = static_cast<Value>(f_.insts[v].imm);
            bool at_end = by == match_[loop] || last_read_[v] == kNone;
            last_read_[v] = at_end ? kNone : by;
        };
        for (Value by = 0; by < f_.insts.size(); ++by) {
            const Inst& inst = f_.insts[by];
            for (Value v : {inst.a, inst.b, inst.c}) read(v, by);
            for (Value v : f_.args_of(inst)) read(v, by);
        }
    }

    Value next_of(Value variable) const {
        auto loop = static_cast<Value>(f_.insts[variable].imm);
        return f_.args_of(f_.insts[match_[loop]])[variable - loop - 1];
    }

    void plan(Value variable) {
        constexpr Value kWorthAMove = 8;
        auto loop = static_cast<Value>(f_.insts[variable].imm);
        Value next = next_of(variable);
        const Inst& inst = f_.insts[next];
        bool ours = region_[next] == loop && next > loop && next != variable;
        if (!ours || !is_pure(inst.op) || last_read_[variable] == kNone) return;
        Value earliest = std::max(variable, last_read_[variable]);
        for (Value v : {inst.a, inst.b, inst.c})
            if (v != kNone) earliest = std::max(earliest, v);
        earliest = settled(earliest, loop);
        if (next > earliest + kWorthAMove) moves_.push_back({earliest, next});
    }

    // The last instruction of the body's own item that `at` belongs to: a whole region inside with
    // its Merges, a call with its Results, all variables of the loop.
    Value settled(Value at, Value loop) const {
        while (region_[at] != loop) at = region_[at];
        if (f_.insts[at].op == Op::If || f_.insts[at].op == Op::Loop) at = match_[at];
        auto follows = [](Op op) {
            return op == Op::Merge || op == Op::LoopOut || op == Op::Result || op == Op::LoopVar;
        };
        while (follows(f_.insts[at + 1].op)) ++at;
        return at;
    }

    void write() {
        std::vector<bool> moved(f_.insts.size(), false);
        for (const Move& move : moves_) moved[move.what] = true;
        std::stable_sort(moves_.begin(), moves_.end(),
                         [](const Move& a, const Move& b) { return a.behind < b.behind; });
        Rewrite r(f_);
        size_t k = 0;
        for (Value v = 0; v < r.old.size(); ++v) {
            if (!moved[v]) r.copy(v);
            for (; k < moves_.size() && moves_[k].behind == v; ++k) r.copy(moves_[k].what);
        }
    }

    Function& f_;
    std::vector<Value> match_, region_, last_read_;
    std::vector<Move> moves_;
};

}  // namespace

void schedule(Module& module) {
    for (Function& function : module.functions) Scheduler(function).run();
}

}  // namespace kinora::jit
