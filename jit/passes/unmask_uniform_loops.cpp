// jit/passes/unmask_uniform_loops.cpp: loops of known rounds that all lanes around enter run
// without a mask of their own, as in `if (a) for (i = 0; i < 4; i += 1) ...`.
//
// Lanes off the mask of an If or Loop see nothing of what is computed inside, so they may as well
// run such a loop: it carries its variables without blends then, and its counter agrees in all
// lanes. What acts in it, and loops that lanes leave apart, keep the mask that it was entered
// under.
#include <algorithm>

#include "jit/ir/analysis.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

class Unmask {
  public:
    Unmask(const Module& module, Function& function)
        : m_(module),
          f_(function),
          match_(match_regions(function)),
          holds_(function.insts.size(), false),
          unmasked_(function.insts.size(), false) {}

    void run() {
        bool any = false;
        for (Value v = 0; v < f_.insts.size(); ++v) {
            if (any) read_entry_masks(f_.insts[v]);
            const Inst& inst = f_.insts[v];
            if (inst.op == Op::EndIf || inst.op == Op::EndLoop) close();
            if (inst.op == Op::Loop) any |= unmasked_[v] = needs_no_mask(v);
            if (inst.op == Op::If || inst.op == Op::Loop) open(inst.op == Op::If ? inst.a : v);
        }
        if (any) write();
    }

  private:
    // The mask of an unmasked loop is, in its body, the one that it was entered under.
    Value entry_mask(Value v) const {
        while (v != kNone && unmasked_[v]) v = f_.insts[v].a;
        return v;
    }
    void read_entry_masks(Inst& inst) {
        for (Value* operand : {&inst.a, &inst.b, &inst.c}) *operand = entry_mask(*operand);
        for (Value k = 0; k < inst.arg_count; ++k)
            f_.args[inst.args + k] = entry_mask(f_.args[inst.args + k]);
    }

    bool needs_no_mask(Value loop) const {
        if (!holds_[f_.insts[loop].a]) return false;
        Value end = match_[loop];
        return trip_count(f_.insts, f_.args_of(f_.insts[end]), loop, end, m_.loop_budget) > 0;
    }

    // In a region its mask holds for all lanes that count, and with it what it is part of.
    void open(Value mask) {
        constexpr int kDepth = 8;
        regions_.push_back(holding_.size());
        hold(mask, kDepth);
    }
    void hold(Value mask, int depth) {
        if (depth == 0 || holds_[mask]) return;
        holds_[mask] = true;
        holding_.push_back(mask);
        const Inst& inst = f_.insts[mask];
        if (inst.op == Op::MAnd || inst.op == Op::MAndNot || inst.op == Op::Loop)
            hold(inst.a, depth - 1);
        if (inst.op == Op::MAnd) hold(inst.b, depth - 1);
    }
    void close() {
        for (; holding_.size() > regions_.back(); holding_.pop_back())
            holds_[holding_.back()] = false;
        regions_.pop_back();
    }

    void write() {
        Rewrite r(f_);
        Value all = kNone;
        for (Value v = 0; v < r.old.size(); ++v) {
            if (all == kNone && r.old[v].op != Op::Param)
                all = r.append({.op = Op::ConstM, .type = Type::M, .imm = 1});
            r.copy(v);
            if (unmasked_[v]) f_.insts.back().a = all;
        }
    }

    const Module& m_;
    Function& f_;
    std::vector<Value> match_;
    std::vector<bool> holds_;      // of masks: all lanes that count have it, here
    std::vector<bool> unmasked_;   // of Loops
    std::vector<Value> holding_;   // masks that hold, ...
    std::vector<size_t> regions_;  // ... and how many did when each open region was entered
};

}  // namespace

void unmask_uniform_loops(Module& module) {
    for (Function& function : module.functions) {
        bool masked =
            std::any_of(function.insts.begin(), function.insts.end(), [&](const Inst& inst) {
                return inst.op == Op::Loop && function.insts[inst.a].op != Op::ConstM;
            });
        if (masked) Unmask(module, function).run();
    }
}

}  // namespace kinora::jit
