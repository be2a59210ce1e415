// jit/passes/fold.cpp: the pass: constants and exact identities, branches and loops that never or
// always run, loop variables that never change.
#include "jit/ir/analysis.h"
#include "jit/ir/fold_inst.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

class Folder {
  public:
    Folder(const Module& module, Function& function)
        : m_(module), match_(match_regions(function)), r_(function) {
        kept_.assign(r_.old.size(), true);
    }

    void run() {
        for (Value v = 0; v < r_.old.size();) v = step(v);
    }

  private:
    // Handles instruction v and returns the next to look at.
    Value step(Value v) {
        const Inst& inst = r_.old[v];
        switch (inst.op) {
            case Op::If:
                return fold_if(v);
            case Op::EndIf:
                return copy_if_kept(v, static_cast<Value>(inst.imm));
            case Op::Merge:
                return fold_merge(v);
            case Op::Loop:
                return fold_loop(v);
            case Op::LoopVar:
                return fold_loop_var(v);
            case Op::EndLoop:
                return fold_end_loop(v);
            case Op::LoopOut:
                return fold_loop_out(v);
            default:
                break;
        }
        if (is_pure(inst.op)) return fold_pure(v);
        if (op_info(inst.op).flags & kEffect) return fold_effect(v);
        r_.copy(v);
        return v + 1;
    }

    // What acts on no lane goes; a call's results in such lanes are free, so zero will do.
    Value fold_effect(Value v) {
        const Inst& inst = r_.old[v];
        Value mask = inst.op == Op::ArrayStore ? inst.c : inst.a;
        if (!is_mask(r_.renamed[mask], false)) {
            r_.copy(v);
            return v + 1;
        }
        Value next = v + 1;
        for (; r_.old[next].op == Op::Result; ++next) {
            Type type = r_.old[next].type;
            r_.renamed[next] = r_.append({.op = constant_op(type), .type = type});
        }
        return next;
    }

    Value copy_if_kept(Value v, Value begin) {
        if (kept_[begin]) r_.copy(v);
        return v + 1;
    }

    Value fold_pure(Value v) {
        Inst inst = r_.translate(v);
        Folded folded =
            inst.op == Op::Lookup ? fold_lookup(inst) : fold_inst(inst, r_.function.insts);
        if (folded.kind == Folded::Same) {
            r_.renamed[v] = folded.same;
        } else if (folded.kind == Folded::Constant) {
            r_.renamed[v] = r_.append({.op = constant_op(inst.type),
                                       .type = inst.type,
                                       .imm = folded.bits,
                                       .where = inst.where});
        } else {
            r_.renamed[v] = r_.append(inst);
        }
        return v + 1;
    }

    Folded fold_lookup(const Inst& inst) const {
        const Inst& index = made(inst.a);
        if (index.op != Op::ConstI) return {};
        auto at = static_cast<size_t>(inst.imm + (index.imm & inst.imm2));
        return {Folded::Constant, kNone, bits_of(m_.table[at])};
    }

    const Inst& made(Value v) const { return r_.function.insts[v]; }
    bool is_mask(Value v, bool value) const {
        return made(v).op == Op::ConstM && (made(v).imm != 0) == value;
    }
    bool same_constant(Value a, Value b) const {
        return is_constant(made(a)) && made(a).op == made(b).op && made(a).imm == made(b).imm;
    }

    Value fold_if(Value v) {
        Value mask = r_.renamed[r_.old[v].a];
        if (is_mask(mask, false)) {
            kept_[v] = false;
            return match_[v] + 1;  // its Merges give their outer arm
        }
        kept_[v] = !is_mask(mask, true);
        if (kept_[v]) r_.copy(v);
        return v + 1;
    }

    // An inner arm of a body that was dropped has no name; one of a body that always runs has.
    Value fold_merge(Value v) {
        const Inst& inst = r_.old[v];
        Value inner = r_.renamed[inst.a], outer = r_.renamed[inst.b];
        if (!kept_[static_cast<Value>(inst.imm)])
            r_.renamed[v] = is_body_dropped(static_cast<Value>(inst.imm)) ? outer : inner;
        else if (inner == outer || same_constant(inner, outer))
            r_.renamed[v] = outer;
        else
            r_.copy(v);
        return v + 1;
    }
    bool is_body_dropped(Value begin) const { return is_mask(r_.renamed[r_.old[begin].a], false); }

    Value fold_loop(Value v) {
        if (is_mask(r_.renamed[r_.old[v].a], false)) {
            kept_[v] = false;
            for (Value k = v + 1; r_.old[k].op == Op::LoopVar; ++k)
                r_.renamed[k] = r_.renamed[r_.old[k].a];
            return match_[v] + 1;
        }
        r_.copy(v);
        return v + 1;
    }

    Value next_of(Value loop_var) const {
        auto begin = static_cast<Value>(r_.old[loop_var].imm);
        return r_.old_args_of(r_.old[match_[begin]])[loop_var - begin - 1];
    }

    // What is given back to itself, or its first constant again, never changes.
    bool never_changes(Value loop_var) const {
        Value next = next_of(loop_var);
        if (next == loop_var) return true;
        Value first = r_.renamed[r_.old[loop_var].a];
        return next < loop_var && r_.renamed[next] != kNone &&
               same_constant(first, r_.renamed[next]);
    }

    Value fold_loop_var(Value v) {
        if (never_changes(v)) {
            kept_[v] = false;
            r_.renamed[v] = r_.renamed[r_.old[v].a];
        } else {
            r_.copy(v);
        }
        return v + 1;
    }

    Value fold_end_loop(Value v) {
        auto begin = static_cast<Value>(r_.old[v].imm);
        Inst inst = r_.translate(v);
        // The loop takes "running and a" itself.
        auto running = static_cast<Value>(inst.imm);
        if (made(inst.a).op == Op::MAnd && made(inst.a).a == running) inst.a = made(inst.a).b;
        if (made(inst.a).op == Op::MAnd && made(inst.a).b == running) inst.a = made(inst.a).a;
        std::vector<Value> next;
        std::span<const Value> old_next = r_.old_args_of(r_.old[v]);
        for (size_t k = 0; k < old_next.size(); ++k)
            if (kept_[begin + 1 + k]) next.push_back(old_next[k]);
        r_.set_renamed_args(inst, next);
        r_.renamed[v] = r_.append(inst);
        return v + 1;
    }

    Value fold_loop_out(Value v) {
        Value loop_var = r_.old[v].a;
        bool gone = !kept_[loop_var] || !kept_[static_cast<Value>(r_.old[loop_var].imm)];
        if (gone)
            r_.renamed[v] = r_.renamed[loop_var];
        else
            r_.copy(v);
        return v + 1;
    }

    const Module& m_;
    std::vector<Value> match_;
    Rewrite r_;
    std::vector<bool> kept_;  // regions and loop variables that stand in the new function
};

}  // namespace

void fold(Module& module) {
    for (Function& function : module.functions) Folder(module, function).run();
}

}  // namespace kinora::jit
