// jit/codegen/liveness.cpp: needed instructions of a function, cycles through loops included.
#include "jit/codegen/liveness_p.h"

#include "jit/ir/analysis.h"
#include "jit/ir/rewrite_p.h"

namespace kinora::jit {

Liveness::Liveness(const Module& module, const Function& function, const std::vector<bool>& effects,
                   Around keep)
    : m_(module),
      f_(function),
      effects_(effects),
      match_(match_regions(function)),
      parent_(function.insts.size(), kNone),
      stores_(function.arrays.size()),
      live_(function.insts.size(), false),
      cuts_(function.insts.size(), false) {
    Value around = kNone;
    for (Value v = 0; v < f_.insts.size(); ++v) {
        const Inst& inst = f_.insts[v];
        bool is_if = inst.op == Op::If || inst.op == Op::EndIf;
        bool counts = keep == Around::Regions || !is_if;
        bool ends = inst.op == Op::EndIf || inst.op == Op::EndLoop;
        if (counts && ends) around = parent_[match_[v]];
        parent_[v] = around;
        if (counts && (inst.op == Op::If || inst.op == Op::Loop)) around = v;
        if (inst.op == Op::ArrayStore) stores_[static_cast<size_t>(inst.imm)].push_back(v);
    }
}

bool Liveness::acts(const Inst& inst) const {
    switch (inst.op) {
        case Op::Fault:
        case Op::Param:
        case Op::Return:
            return true;
        case Op::Service:
            return !m_.services[static_cast<size_t>(inst.imm)].pure;
        case Op::Call:
            return effects_[static_cast<size_t>(inst.imm)];
        default:
            return false;
    }
}

void Liveness::mark_effects() {
    for (Value v = 0; v < f_.insts.size(); ++v)
        if (acts(f_.insts[v])) mark(v);
}

void Liveness::push(Value v) {
    if (v == kNone || live_[v]) return;
    live_[v] = true;
    work_.push_back(v);
}

void Liveness::mark(Value v) {
    push(v);
    while (!work_.empty()) {
        Value next = work_.back();
        work_.pop_back();
        if (!cuts_[next]) visit(next);
    }
}

void Liveness::visit(Value v) {
    const Inst& inst = f_.insts[v];
    push(parent_[v]);
    if (op_info(inst.op).flags & (kControl | kEffect)) return visit_control(v, inst);
    push(inst.a);
    push(inst.b);
    push(inst.c);
    if (inst.op == Op::ArrayLoad)
        for (Value store : stores_[static_cast<size_t>(inst.imm)]) push(store);
}

void Liveness::visit_control(Value v, const Inst& inst) {
    push(inst.a);
    push(inst.b);
    push(inst.c);
    switch (inst.op) {
        case Op::If:
            return push(match_[v]);
        case Op::Loop:
            push(match_[v]);
            return push(f_.insts[match_[v]].a);
        case Op::EndIf:
        case Op::EndLoop:
            return;  // a loop's values are pushed by the variables that are live
        case Op::Merge:
            return push(static_cast<Value>(inst.imm));
        case Op::LoopVar: {
            auto begin = static_cast<Value>(inst.imm);
            push(begin);
            return push(f_.args_of(f_.insts[match_[begin]])[v - begin - 1]);
        }
        case Op::Call:
        case Op::Service:
            for (Value k = v + 1; f_.insts[k].op == Op::Result; ++k) push(k);
            break;
        default:
            break;
    }
    for (Value arg : f_.args_of(inst)) push(arg);
}

void keep_live(Function& function, const Liveness& live) {
    const std::vector<Value>& match = live.match();
    Rewrite r(function);
    for (Value v = 0; v < r.old.size(); ++v) {
        if (!live.is_live(v)) continue;
        if (r.old[v].op != Op::EndLoop) {
            r.copy(v);
            continue;
        }
        Inst inst = r.translate(v);
        std::vector<Value> next;
        std::span<const Value> old_next = r.old_args_of(r.old[v]);
        for (Value k = 0; k < old_next.size(); ++k)
            if (live.is_live(match[v] + 1 + k)) next.push_back(old_next[k]);
        r.set_renamed_args(inst, next);
        r.renamed[v] = r.append(inst);
    }
}

}  // namespace kinora::jit
