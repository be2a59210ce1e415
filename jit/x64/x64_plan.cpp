// jit/x64/x64_plan.cpp: what needs a register, what is a memory operand, what is computed in place.
#include "jit/x64/x64_plan_p.h"

#include "jit/analysis.h"

namespace kinora::jit::x64 {

namespace {

bool is_compare(Op op) {
    return op == Op::Lt || op == Op::Le || op == Op::Eq || op == Op::ILt || op == Op::IEq;
}

class Planner {
  public:
    Planner(const Module& m, const Function& f, const Structure& s, const Isa& isa)
        : m_(m), f_(f), s_(s), isa_(isa) {}

    FunctionPlan run() {
        size_t n = f_.insts.size();
        plan_.values.resize(n);
        plan_.branch.assign(n, 0);
        plan_.agree = lanes_agree(m_, f_);
        count_uses();
        for (Value v = 0; v < n; ++v) plan_value(v);
        for (Value v = 0; v < n; ++v) fuse_operands(v);
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
        return inst.type == Type::M && isa_.wide ? RegClass::Mask : RegClass::Vector;
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
                p.clobber = true;
                plan_.calls = true;
                break;
            default:
                break;
        }
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
        return uses_[v] == 1 && s_.loop_of[v] == s_.loop_of[at] && !is_fused_into(v);
    }
    bool is_fused_into(Value v) const { return f_.insts[v].op == Op::LoopOut; }

    void fuse_operands(Value at) {
        const Inst& inst = f_.insts[at];
        switch (inst.op) {
            case Op::Fma:
                for (Value v : {inst.a, inst.b, inst.c})
                    if (f_.insts[v].op == Op::Neg && fusible(v, at)) value(v).fused = true;
                return;
            case Op::MNot:
                fuse_compare(inst.a, at);
                return;
            case Op::MAnd:
                if (isa_.wide && !fuse_compare(inst.b, at)) fuse_compare(inst.a, at);
                return;
            case Op::MAndNot:
                if (isa_.wide) fuse_compare(inst.b, at);
                return;
            default:
                return;
        }
    }

    // AVX2 has inverted compares for floats only.
    bool fuse_compare(Value v, Value at) {
        Op op = f_.insts[v].op;
        if (!is_compare(op) || !fusible(v, at)) return false;
        if (!isa_.wide && (op == Op::ILt || op == Op::IEq)) return false;
        return value(v).fused = true;
    }

    const Module& m_;
    const Function& f_;
    const Structure& s_;
    const Isa& isa_;
    FunctionPlan plan_;
    std::vector<uint32_t> uses_;
    std::vector<Value> user_;  // the last one
};

}  // namespace

FunctionPlan plan_function(const Module& module, const Function& function,
                           const Structure& structure, const Isa& isa) {
    return Planner(module, function, structure, isa).run();
}

AllocationLimits limits(const Isa& isa, const FunctionPlan& plan, bool is_kernel) {
    AllocationLimits limits;
    limits.registers[0] = isa.vector_registers;
    limits.registers[1] = isa.mask_registers;
    limits.first[1] = isa.wide ? 1 : 0;
    limits.hoist_function = is_kernel && !plan.calls;
    return limits;
}

}  // namespace kinora::jit::x64
