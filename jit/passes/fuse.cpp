// jit/passes/fuse.cpp: regions that run together become one: loops over the same records
// (ambient(), diffuse() and specular() of one surface), and Ifs of the same mask.
//
// What stands between the two either does not need the first, and goes before it, or is not needed
// by the second, and goes behind. So what both compute (the light's direction, say) stands side by
// side, and cse() finds it. Of the fault sites of fused loops the first one's speaks for all.
#include <algorithm>

#include "jit/ir/analysis.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

constexpr int kMaxFusions = 64;    // of a function: keeps the pass linear
constexpr int kMaxDistance = 256;  // items between two regions

class Fuse {
  public:
    Fuse(const Module& module, Function& function, const std::vector<bool>& effects)
        : m_(module), f_(function), effects_(effects), match_(match_regions(function)) {}

    // Fuses the first pair that can be; false if there is none.
    bool run() {
        for (Value v = 0; v < f_.insts.size(); ++v) {
            Op op = f_.insts[v].op;
            if (op == Op::If || (op == Op::Loop && is_record_loop(v))) first_ = v;
            if (first_ != v || !find_second()) continue;
            write();
            return true;
        }
        return false;
    }

  private:
    using Pair = std::pair<Value, Value>;

    const Inst& inst(Value v) const { return f_.insts[v]; }

    // A region with its Merges or LoopOuts, a call with its Results, or one instruction.
    Value end_of_item(Value v) const {
        Op op = inst(v).op, follower = Op::Result;
        Value end = v + 1;
        if (op == Op::If || op == Op::Loop) {
            end = match_[v] + 1;
            follower = op == Op::If ? Op::Merge : Op::LoopOut;
        }
        while (inst(end).op == follower) ++end;
        return end;
    }

    bool acts(Value begin, Value end) const {
        return std::any_of(f_.insts.begin() + begin, f_.insts.begin() + end, [&](const Inst& i) {
            auto index = static_cast<size_t>(i.imm);
            if (i.op == Op::Call) return bool(effects_[index]);
            if (i.op == Op::Service) return !m_.services[index].pure;
            return i.op == Op::Fault || i.op == Op::ArrayStore;
        });
    }

    // Goes on while a counter is below a record set's count.
    bool is_record_loop(Value loop) const {
        const Inst& condition = inst(inst(match_[loop]).a);
        return condition.op == Op::ILt && inst(condition.b).op == Op::RecordCount;
    }

    bool find_second() {
        first_end_ = end_of_item(first_);
        if (acts(first_, first_end_)) return false;
        late_.assign(f_.insts.size(), false);
        Value v = first_end_;
        for (int k = 0; k < kMaxDistance; ++k) {
            Op op = inst(v).op;
            if (op == Op::EndIf || op == Op::EndLoop || op == Op::Return) return false;
            Value end = end_of_item(v);
            if (acts(v, end)) return false;
            bool needs_first = needs(v, end, false);
            if (op == inst(first_).op && runs_with_first(v) &&
                !(op == Op::If ? needs(v, end, true) : needs_first)) {
                second_ = v;
                second_end_ = end;
                return true;
            }
            std::fill(late_.begin() + v, late_.begin() + end, needs_first);
            v = end;
        }
        return false;
    }

    // Does anything in the range need the first region or what needs it? Its merges may be allowed:
    // under the same mask they are the values inside.
    bool needs(Value begin, Value end, bool but_merges) const {
        auto needed = [&](Value v) {
            if (v == kNone) return false;
            if (late_[v]) return true;
            bool inside = v >= first_ && v < first_end_;
            return inside && !(but_merges && inst(v).op == Op::Merge && v > match_[first_]);
        };
        for (Value v = begin; v < end; ++v) {
            const Inst& i = inst(v);
            std::span<const Value> args = f_.args_of(i);
            if (needed(i.a) || needed(i.b) || needed(i.c) ||
                std::any_of(args.begin(), args.end(), needed))
                return true;
        }
        return false;
    }

    bool runs_with_first(Value v) {
        if (inst(v).a != inst(first_).a) return false;
        if (inst(v).op == Op::If) return true;
        second_ = v;
        same_.clear();
        return is_record_loop(v) && equal(inst(match_[first_]).a, inst(match_[v]).a);
    }

    // Are x of the first loop and y of the second the same in every round? Variables are, if they
    // start the same and, supposing they are, go on the same.
    bool equal(Value x, Value y) {
        if (x == y || (x == first_ && y == second_)) return true;
        if (std::find(same_.begin(), same_.end(), Pair{x, y}) != same_.end()) return true;
        if (x == kNone || y == kNone || x < first_ || x > match_[first_] || y < second_)
            return false;
        const Inst &i = inst(x), &j = inst(y);
        if (i.op != j.op || i.type != j.type || i.imm2 != j.imm2) return false;
        if (i.op == Op::LoopVar) {
            if (Value(i.imm) != first_ || Value(j.imm) != second_ || i.a != j.a) return false;
            same_.push_back({x, y});
            return equal(next(first_, x), next(second_, y));
        }
        return is_pure(i.op) && i.imm == j.imm && equal(i.a, j.a) && equal(i.b, j.b) &&
               equal(i.c, j.c);
    }
    Value next(Value loop, Value variable) const {
        return f_.args_of(inst(match_[loop]))[variable - loop - 1];
    }

    // The first region's variable that this one of the second is, or kNone.
    Value twin(Value variable) const {
        for (auto [x, y] : same_)
            if (y == variable) return x;
        return kNone;
    }

    void write() {
        Rewrite r(f_);
        copy(r, 0, first_);
        copy_between(r, false);
        Value behind = r.old[first_].op == Op::If ? write_if(r) : write_loop(r);
        copy_between(r, true);
        copy(r, behind, static_cast<Value>(r.old.size()));
    }

    static void copy(Rewrite& r, Value begin, Value end) {
        for (Value v = begin; v < end; ++v) r.copy(v);
    }
    void copy_between(Rewrite& r, bool late) const {
        for (Value v = first_end_; v < second_; ++v)
            if (late_[v] == late) r.copy(v);
    }

    Value write_if(Rewrite& r) const {
        Value first_close = match_[first_], second_close = match_[second_];
        copy(r, first_, first_close);
        r.renamed[second_] = r.renamed[first_];
        for (Value m = first_close + 1; m < first_end_; ++m) r.renamed[m] = r.renamed[r.old[m].a];
        copy(r, second_ + 1, second_close);
        std::vector<Inst> merges;
        for (Value m = second_close + 1; m < second_end_; ++m) {
            Inst merge = r.translate(m);
            Value outer = r.old[m].b;
            if (outer > first_close && outer < first_end_) merge.b = r.renamed[r.old[outer].b];
            merges.push_back(merge);
        }
        copy(r, first_close, first_end_);
        for (size_t k = 0; k < merges.size(); ++k)
            r.renamed[second_close + 1 + k] = r.append(merges[k]);
        return second_end_;
    }

    Value write_loop(Rewrite& r) const {
        Value first_body = body_of(r, first_), second_body = body_of(r, second_);
        copy(r, first_, first_body);
        r.renamed[second_] = r.renamed[first_];
        std::span<const Value> more = r.old_args_of(r.old[match_[second_]]);
        std::vector<Value> next(r.old_args_of(r.old[match_[first_]]).begin(),
                                r.old_args_of(r.old[match_[first_]]).end());
        for (Value v = second_ + 1; v < second_body; ++v) {
            if (Value x = twin(v); x != kNone) {
                r.renamed[v] = r.renamed[x];
                continue;
            }
            r.copy(v);
            next.push_back(more[v - second_ - 1]);
        }
        copy(r, first_body, match_[first_]);
        copy(r, second_body, match_[second_]);
        Inst end = r.translate(match_[first_]);
        r.set_renamed_args(end, next);
        r.append(end);
        copy(r, match_[first_] + 1, first_end_);
        copy(r, match_[second_] + 1, second_end_);
        return second_end_;
    }
    static Value body_of(const Rewrite& r, Value loop) {
        Value v = loop + 1;
        while (r.old[v].op == Op::LoopVar) ++v;
        return v;
    }

    const Module& m_;
    Function& f_;
    const std::vector<bool>& effects_;
    std::vector<Value> match_;
    Value first_ = kNone, first_end_ = kNone, second_ = kNone, second_end_ = kNone;
    std::vector<bool> late_;  // stands between and needs the first region
    std::vector<Pair> same_;  // variables of the two loops that are one
};

}  // namespace

bool fuse(Module& module) {
    bool changed = false;
    std::vector<bool> effects = has_effects(module);
    for (Function& function : module.functions)
        for (int k = 0; k < kMaxFusions && Fuse(module, function, effects).run(); ++k)
            changed = true;
    return changed;
}

}  // namespace kinora::jit
