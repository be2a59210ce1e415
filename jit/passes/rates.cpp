// jit/passes/rates.cpp: rate inference over the kernel, a least fixpoint because loops feed
// themselves.
#include "jit/passes/rates.h"

#include <algorithm>

#include "jit/ir/analysis.h"

namespace kinora::jit {

namespace {

// Functions whose results follow from their arguments alone.
std::vector<bool> plain_functions(const Module& module) {
    std::vector<bool> plain = has_effects(module);
    plain.flip();
    bool changed = true;
    while (changed) {
        changed = false;
        for (size_t k = 0; k < plain.size(); ++k) {
            if (!plain[k]) continue;
            for (const Inst& inst : module.functions[k].insts) {
                bool reads = inst.op == Op::RecordCount || inst.op == Op::RecordField ||
                             inst.op == Op::RecordUniform || inst.op == Op::Input ||
                             inst.op == Op::InputGather;
                bool calls = inst.op == Op::Call && !plain[static_cast<size_t>(inst.imm)];
                if (!reads && !calls) continue;
                plain[k] = false;
                changed = true;
                break;
            }
        }
    }
    return plain;
}

class RateInference {
  public:
    explicit RateInference(const Module& module)
        : m_(module),
          f_(module.kernel()),
          match_(match_regions(f_)),
          plain_(plain_functions(module)) {
        rates_.rate.assign(f_.insts.size(), Rate::Constant);
        rates_.in_loop.assign(f_.insts.size(), false);
    }

    Rates run() {
        bool changed = true;
        while (changed) {
            changed = false;
            for (Value v = 0; v < f_.insts.size(); ++v) {
                Rate rate = rate_of(v);
                changed |= rate != rates_.rate[v];
                rates_.rate[v] = rate;
            }
            if (!has_loops_) break;
        }
        mark_loops();
        return std::move(rates_);
    }

  private:
    Rate at(Value v) const { return v == kNone ? Rate::Constant : rates_.rate[v]; }

    Rate rate_of(Value v) {
        const Inst& inst = f_.insts[v];
        switch (inst.op) {
            case Op::Input:
                return m_.inputs[static_cast<size_t>(inst.imm)].rate;
            case Op::InputGather:
                return gather_rate(inst);
            case Op::FrameLoad:
                return Rate::Frame;
            case Op::FrameGather:
                return std::max(Rate::Frame, at(inst.a));
            case Op::RecordCount:
            case Op::RecordField:
            case Op::RecordUniform:
            case Op::ArrayLoad:
            case Op::Param:
                return Rate::Point;
            case Op::Merge:
                return std::max({at(inst.a), at(inst.b), at(region_mask(inst))});
            case Op::Loop:
                has_loops_ = true;
                return std::max(at(inst.a), at(f_.insts[match_[v]].a));
            case Op::LoopVar:
                return loop_var_rate(v, inst);
            case Op::Result:
                return result_rate(inst);
            default:
                return std::max({at(inst.a), at(inst.b), at(inst.c)});
        }
    }

    Value region_mask(const Inst& merge) const { return f_.insts[static_cast<Value>(merge.imm)].a; }

    Rate gather_rate(const Inst& inst) const {
        Rate rate = at(inst.a);
        for (int32_t k = 0; k < inst.imm2; ++k)
            rate = std::max(rate, m_.inputs[static_cast<size_t>(inst.imm + k)].rate);
        return rate;
    }

    Rate loop_var_rate(Value v, const Inst& inst) const {
        auto begin = static_cast<Value>(inst.imm);
        Value next = f_.args_of(f_.insts[match_[begin]])[v - begin - 1];
        return std::max({at(begin), at(inst.a), at(next)});
    }

    // Results in lanes off the mask are free, so the mask does not count: the frame kernel asks
    // with a mask of its own.
    Rate result_rate(const Inst& inst) const {
        const Inst& call = f_.insts[inst.a];
        auto index = static_cast<size_t>(call.imm);
        bool plain = call.op == Op::Call ? plain_[index] : m_.services[index].pure;
        if (!plain) return Rate::Point;
        Rate rate = Rate::Frame;
        for (Value arg : f_.args_of(call)) rate = std::max(rate, at(arg));
        return rate;
    }

    void mark_loops() {
        int depth = 0;
        for (Value v = 0; v < f_.insts.size(); ++v) {
            if (f_.insts[v].op == Op::Loop) ++depth;
            // An Input is the same wherever it is read.
            rates_.in_loop[v] = depth > 0 && f_.insts[v].op != Op::Input;
            if (f_.insts[v].op == Op::EndLoop) --depth;
        }
    }

    const Module& m_;
    const Function& f_;
    std::vector<Value> match_;
    std::vector<bool> plain_;
    Rates rates_;
    bool has_loops_ = false;
};

}  // namespace

Rates infer_rates(const Module& module) {
    return RateInference(module).run();
}

}  // namespace kinora::jit
