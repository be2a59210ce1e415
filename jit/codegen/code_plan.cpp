// jit/codegen/code_plan.cpp: what needs a register, what lies in memory, what its user computes.
#include "jit/codegen/code_plan_p.h"

#include "jit/codegen/loop_slices_p.h"
#include "jit/ir/analysis.h"
#include "jit/ir/fold_inst.h"
#include "jit/ir/ieee_scope_p.h"
#include "jit/ir/planted_fault.h"

namespace kinora::jit {

namespace {

class Planner {
  public:
    Planner(const Module& m, const Function& f, const Structure& s, const PlanRules& rules)
        : m_(m), f_(f), s_(s), rules_(rules) {}

    FunctionPlan run() {
        size_t n = f_.insts.size();
        plan_.values.resize(n);
        plan_.branch.assign(n, 0);
        plan_.in_range.assign(n, false);
        plan_.counted.assign(n, kNone);
        plan_.rounds.assign(n, 0);
        plan_.agree = lanes_agree(m_, f_);
        count_uses();
        for (Value v = 0; v < n; ++v) plan_value(v);
        for (Value v = 0; v < n; ++v) fuse_operands(v);
        for (Value v = 0; v < n; ++v) plan_.in_range[v] = reads_in_range(f_.insts[v]);
        if (rules_.counted_loops) {
            plan_record_loops();
            plan_known_loops();
        }
        alias_variables();
        plan_.slices = loop_slices(m_, f_, s_, plan_);
        return std::move(plan_);
    }

  private:
    ValuePlan& value(Value v) { return plan_.values[v]; }

    void count_uses() {
        uses_.assign(f_.insts.size(), 0);
        user_.assign(f_.insts.size(), kNone);
        auto use = [&](Value v, Value by) {
            ++uses_[v];
            user_[v] = by;
        };
        for (Value v = 0; v < f_.insts.size(); ++v) {
            const Inst& inst = f_.insts[v];
            const Value operands[] = {inst.a, inst.b, inst.c};
            for (int k = 0; k < op_info(inst.op).operand_count; ++k) use(operands[k], v);
            for (Value arg : f_.args_of(inst)) use(arg, v);
        }
    }

    RegClass class_of(const Inst& inst) const {
        if (inst.type == Type::None) return RegClass::None;
        return inst.type == Type::M && rules_.mask_registers ? RegClass::Mask : RegClass::Vector;
    }

    void plan_value(Value v) {
        const Inst& inst = f_.insts[v];
        ValuePlan& p = value(v);
        p.cls = class_of(inst);
        switch (inst.op) {
            case Op::ConstF:
            case Op::ConstI:
            case Op::ConstM:
                p.hoist = p.cls == RegClass::Vector;
                p.cls = RegClass::None;
                break;
            case Op::FrameLoad:
                if (p.cls == RegClass::Mask) break;
                p.hoist = true;
                p.cls = RegClass::None;
                break;
            case Op::Input:
                plan_input(v);
                break;
            case Op::Param:
                p.home = p.cls == RegClass::Vector;
                break;
            case Op::If:
                p.masked = !plan_.agree[inst.a];
                plan_.branch[v] = !p.masked || worth_a_branch(v);
                break;
            case Op::Loop:
                p.masked = !plan_.agree[inst.a] || !plan_.agree[f_.insts[s_.end_of[v]].a];
                if (!p.masked) p.cls = RegClass::None;
                break;
            case Op::LoopOut:
                p.cls = RegClass::None;
                break;
            case Op::Call:
            case Op::Service:
                p.clobber = !planted(PlantedFault::CallKeepsRegisters);
                plan_.calls = true;
                break;
            default:
                break;
        }
    }

    // Record `b` of a loop over all records: it starts at c >= 0 if c < count, goes on with
    // b + 1 if that is < count. All lanes agree, and nothing is called that could change the set.
    bool reads_in_range(const Inst& read) const {
        if (read.op != Op::RecordField && read.op != Op::RecordUniform) return false;
        const Inst& index = f_.insts[read.b];
        if (index.op != Op::LoopVar || (plan_.calls && f_.insts[read.a].op != Op::ConstI))
            return false;
        auto loop = static_cast<Value>(index.imm);
        const Inst& end = f_.insts[s_.end_of[loop]];
        const Inst& start = f_.insts[index.a];
        Value next = f_.args_of(end)[read.b - loop - 1];
        const Inst& step = f_.insts[next];
        return !plan_.values[loop].masked && start.op == Op::ConstI && start.imm >= 0 &&
               step.op == Op::IAdd && step.a == read.b && f_.insts[step.b].op == Op::ConstI &&
               f_.insts[step.b].imm == 1 && is_below_count(f_.insts[loop].a, index.a, read.a) &&
               is_below_count(end.a, next, read.a);
    }
    bool is_below_count(Value mask, Value index, Value set) const {
        const Inst& less = f_.insts[mask];
        return less.op == Op::ILt && less.a == index && f_.insts[less.b].op == Op::RecordCount &&
               f_.insts[less.b].a == set;
    }

    // Loops over records count and branch in general registers.
    void plan_record_loops() {
        std::vector<uint32_t> reads(f_.insts.size(), 0);
        bool any = false;
        for (Value v = 0; v < f_.insts.size(); ++v) {
            if (!plan_.in_range[v]) continue;
            ++reads[f_.insts[v].b];
            any = true;
        }
        if (!any) return;
        for (Value v = 0; v < f_.insts.size(); ++v)
            if (f_.insts[v].op == Op::Loop) count_in_budget(v, reads);
        plan_kind_tests();
    }

    void count_in_budget(Value loop, const std::vector<uint32_t>& reads) {
        constexpr int32_t kFar = 1 << 29;
        const Inst& end = f_.insts[s_.end_of[loop]];
        const Inst& less = f_.insts[end.a];
        if (plan_.calls || s_.depth[loop] > 1 || less.op != Op::ILt || uses_[end.a] != 1) return;
        const Inst& step = f_.insts[less.a];
        if (step.op != Op::IAdd || uses_[less.a] != 2 || reads[step.a] == 0 ||
            uses_[step.a] != reads[step.a] + 1)
            return;
        // Records are read by it in range: it steps by 1 from a constant to a set's count.
        const Inst& variable = f_.insts[step.a];
        bool ours = variable.op == Op::LoopVar && static_cast<Value>(variable.imm) == loop &&
                    f_.args_of(end)[step.a - loop - 1] == less.a;
        if (!ours || f_.insts[f_.insts[less.b].a].op != Op::ConstI ||
            f_.insts[variable.a].imm > kFar || m_.loop_budget > kFar)
            return;
        plan_.counted[loop] = step.a;
        value(step.a).cls = RegClass::None;
        value(less.a).fused = value(end.a).fused = true;
    }

    // Ifs on what kind of record it is, which all lanes take together: nothing but the branch asks
    // for the comparison. Backward, so that the users of a value are known.
    void plan_kind_tests() {
        std::vector<bool> wanted(f_.insts.size(), false), tested(f_.insts.size(), false);
        for (auto at = static_cast<Value>(f_.insts.size()); at-- > 0;) {
            const Inst& inst = f_.insts[at];
            tested[at] = tests_kind(at) && !wanted[at];
            if (inst.op == Op::If && !value(at).masked && tests_kind(inst.a)) continue;
            if (inst.op == Op::RecordUniform && uses_[at] == 1) tested[at] = tested[user_[at]];
            if (tested[at]) {
                value(at).fused = true;
                continue;
            }
            const Value operands[] = {inst.a, inst.b, inst.c};
            for (int k = 0; k < op_info(inst.op).operand_count; ++k) wanted[operands[k]] = true;
            for (Value arg : f_.args_of(inst)) wanted[arg] = true;
        }
    }
    bool tests_kind(Value v) const {
        const Inst& inst = f_.insts[v];
        if (inst.op == Op::MNot) return f_.insts[inst.a].op == Op::IEq && tests_kind(inst.a);
        return inst.op == Op::IEq && f_.insts[inst.a].op == Op::RecordUniform &&
               plan_.in_range[inst.a] && f_.insts[inst.b].op == Op::ConstI && uses_[inst.a] == 1;
    }

    // Loops that go from one constant to another in constant steps: all lanes that enter one leave
    // it together, so the mask of a masked one stays what it was.
    void plan_known_loops() {
        IeeeScope ieee;  // counts as precise kernels do
        for (Value v = 0; v < f_.insts.size(); ++v) {
            if (f_.insts[v].op != Op::Loop || plan_.counted[v] != kNone) continue;
            const Inst& end = f_.insts[s_.end_of[v]];
            if (uses_[end.a] != 1 || value(end.a).fused) continue;
            plan_.rounds[v] =
                trip_count(f_.insts, f_.args_of(end), v, s_.end_of[v], m_.loop_budget);
            if (plan_.rounds[v] > 0) drop_condition(v, end);
        }
    }

    // Nothing asks for the comparison any more, and perhaps nothing for what it compares.
    void drop_condition(Value loop, const Inst& end) {
        value(end.a).fused = value(end.a).gone = true;
        const Inst& condition = f_.insts[end.a];
        Value next = is_constant(f_.insts[condition.a]) ? condition.b : condition.a;
        const Inst& step = f_.insts[next];
        Value variable = is_constant(f_.insts[step.a]) ? step.b : step.a;
        if (uses_[next] != 2 || uses_[variable] != 1) return;
        plan_.counted[loop] = variable;
        value(variable).cls = RegClass::None;
        value(next).fused = value(next).gone = true;
    }

    // An input read once is an operand in memory where it is used.
    void plan_input(Value v) {
        ValuePlan& p = value(v);
        if (p.cls != RegClass::Vector) return;
        p.home = true;
        bool once = uses_[v] == 1 && s_.depth[user_[v]] == 0;
        if (once || uses_[v] == 0) p.cls = RegClass::None;
    }

    // A mispredicted branch costs more than a few pure operations; reads stay behind their guard.
    bool worth_a_branch(Value begin) const {
        constexpr Value kFewOps = 8;
        Value end = s_.end_of[begin];
        if (end - begin > kFewOps) return true;
        for (Value v = begin + 1; v < end; ++v) {
            Op op = f_.insts[v].op;
            if (!is_pure(op) || op == Op::Div || op == Op::Sqrt || op == Op::InputGather ||
                op == Op::FrameGather)
                return true;
        }
        return false;
    }

    // May `v` be computed inside its user at `at`?
    bool fusible(Value v, Value at) const {
        return uses_[v] == 1 && s_.loop_of[v] == s_.loop_of[at];
    }

    void fuse_operands(Value at) {
        const Inst& inst = f_.insts[at];
        switch (inst.op) {
            case Op::Fma:
                for (Value v : {inst.a, inst.b, inst.c})
                    if (f_.insts[v].op == Op::Neg && fusible(v, at)) value(v).fused = true;
                return;
            case Op::MNot:
                if (rules_.inverted_compares) fuse_compare(inst.a, at);
                return;
            case Op::MAnd:
                if (rules_.mask_registers && !fuse_compare(inst.b, at)) fuse_compare(inst.a, at);
                return;
            case Op::MAndNot:
                if (rules_.mask_registers) fuse_compare(inst.b, at);
                return;
            case Op::Select:
                return fuse_arm(inst, at);
            default:
                return;
        }
    }

    // AVX-512: an arm computed under the mask, over the other arm.
    void fuse_arm(const Inst& select, Value at) {
        if (!rules_.mask_registers || value(at).cls != RegClass::Vector || select.b == select.c)
            return;
        const Inst& arm = f_.insts[select.b];
        bool in_place = arm.op == Op::Add || arm.op == Op::Sub || arm.op == Op::Mul ||
                        (arm.op == Op::Neg && arm.a == select.c) ||
                        (arm.op == Op::Fma && arm.c == select.c);
        if (in_place && fusible(select.b, at)) value(select.b).fused = true;
    }

    // In a loop that all lanes run together, the next value of a variable is computed where the
    // variable lies, if the variable is not read after that.
    void alias_variables() {
        bool any = false;
        for (Value v = 0; v < f_.insts.size(); ++v)
            any = any || (f_.insts[v].op == Op::Loop && !value(v).masked);
        if (!any) return;
        find_last_reads();
        for (Value v = 0; v < f_.insts.size(); ++v)
            if (f_.insts[v].op == Op::Loop && !value(v).masked) alias_variables_of(v);
    }

    // Its own EndLoop apart, which alias_variables_of looks at.
    void find_last_reads() {
        last_read_.assign(f_.insts.size(), 0);
        for (Value at = 0; at < f_.insts.size(); ++at) {
            for_each_use(f_, s_, plan_.values, at, [&](Value v) {
                const Inst& inst = f_.insts[v];
                if (inst.op == Op::LoopVar && at < s_.end_of[static_cast<Value>(inst.imm)])
                    last_read_[v] = at;
            });
        }
    }

    void alias_variables_of(Value loop) {
        const Inst& end = f_.insts[s_.end_of[loop]];
        std::span<const Value> next = f_.args_of(end);
        std::vector<bool> read_at_end(next.size());
        auto note = [&](Value v) {
            if (v > loop && v - loop - 1 < next.size()) read_at_end[v - loop - 1] = true;
        };
        note(end.a);
        for (Value v : next) note(v);
        for (size_t k = 0; k < next.size(); ++k) {
            Value variable = loop + 1 + static_cast<Value>(k);
            if (read_at_end[k] || !may_alias(loop, variable, next[k])) continue;
            value(next[k]).alias = variable;
            alias_arm(variable, next[k]);
        }
    }

    // An If that all lanes take together writes its value over the variable it starts as, where
    // nothing reads the variable any more.
    void alias_arm(Value variable, Value merge) {
        const Inst& inst = f_.insts[merge];
        if (inst.op != Op::Merge || inst.b != variable) return;
        auto begin = static_cast<Value>(inst.imm);
        Value arm = inst.a;
        const Inst& made = f_.insts[arm];
        ValuePlan& p = value(arm);
        bool inside = arm > begin && arm < s_.end_of[begin] && s_.loop_of[arm] == s_.loop_of[merge];
        if (value(begin).masked || !inside || p.cls != value(merge).cls || p.home || p.fused ||
            p.alias != kNone || made.op == Op::Merge || made.op == Op::LoopVar ||
            made.op == Op::Loop || made.op == Op::LoopOut || last_read_[variable] > arm)
            return;
        p.alias = variable;
    }

    bool may_alias(Value loop, Value variable, Value next) const {
        const Inst& inst = f_.insts[next];
        const ValuePlan& p = plan_.values[next];
        if (p.cls != plan_.values[variable].cls || p.cls == RegClass::None || p.home || p.fused ||
            p.alias != kNone || s_.loop_of[next] != loop || inst.op == Op::LoopVar ||
            inst.op == Op::Loop || inst.op == Op::LoopOut)
            return false;
        if (inst.op != Op::Merge) return last_read_[variable] <= next;
        // A Merge is first written at its If, or at its EndIf if it starts as the variable.
        auto begin = static_cast<Value>(inst.imm);
        return inst.b == variable ? last_read_[variable] < s_.end_of[begin]
                                  : last_read_[variable] < begin;
    }

    // Without mask registers there are inverted compares for floats only.
    bool fuse_compare(Value v, Value at) {
        Op op = f_.insts[v].op;
        if (!is_compare(op) || !fusible(v, at)) return false;
        if (!rules_.mask_registers && (op == Op::ILt || op == Op::IEq)) return false;
        return value(v).fused = true;
    }

    const Module& m_;
    const Function& f_;
    const Structure& s_;
    const PlanRules& rules_;
    FunctionPlan plan_;
    std::vector<uint32_t> uses_;
    std::vector<Value> user_;       // the last one
    std::vector<Value> last_read_;  // of a LoopVar, inside its loop
};

}  // namespace

FunctionPlan plan_function(const Module& module, const Function& function,
                           const Structure& structure, const PlanRules& rules) {
    return Planner(module, function, structure, rules).run();
}

}  // namespace kinora::jit
