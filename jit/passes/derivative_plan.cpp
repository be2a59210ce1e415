// jit/passes/derivative_plan.cpp: activity forwards, need backwards, both to a fixpoint through
// loops.
#include "jit/passes/derivative_plan_p.h"

#include "jit/ir/analysis.h"

namespace kinora::jit {

namespace {

constexpr uint8_t kBoth = kAlongU | kAlongV;

class Planner {
  public:
    Planner(const Module& module, const Function& function, uint8_t params,
            const std::vector<bool>& asks)
        : m_(module),
          f_(function),
          params_(params),
          asks_(asks),
          match_(match_regions(function)),
          active_(function.insts.size(), 0),
          need_(function.insts.size(), 0),
          array_active_(function.arrays.size(), 0),
          array_need_(function.arrays.size(), 0) {}

    DerivativePlan run() {
        repeat([&] {
            for (Value v = 0; v < f_.insts.size(); ++v) raise(active_[v], activity(v));
        });
        repeat([&] {
            for (Value v = static_cast<Value>(f_.insts.size()); v-- > 0;) spread_need(v);
        });
        for (size_t v = 0; v < need_.size(); ++v) need_[v] &= active_[v];
        for (size_t k = 0; k < array_need_.size(); ++k) array_need_[k] &= array_active_[k];
        return {std::move(need_), std::move(array_need_)};
    }

  private:
    template <class Round>
    void repeat(Round round) {
        do {
            changed_ = false;
            round();
        } while (changed_);
    }
    void raise(uint8_t& bits, uint8_t more) {
        if ((bits | more) == bits) return;
        bits |= more;
        changed_ = true;
    }

    Value next_of(Value loop_var) const {
        auto begin = static_cast<Value>(f_.insts[loop_var].imm);
        return f_.args_of(f_.insts[match_[begin]])[loop_var - begin - 1];
    }

    uint8_t activity(Value v) {
        const Inst& inst = f_.insts[v];
        if (inst.op == Op::ArrayStore)
            raise(array_active_[static_cast<size_t>(inst.imm)], active_[inst.b]);
        if (inst.type != Type::F) return 0;
        auto of = [&](Value x) { return x == kNone ? uint8_t{0} : active_[x]; };
        switch (inst.op) {
            case Op::Input:
                return input_activity(inst.imm, 1, false);
            case Op::InputGather:
                return input_activity(inst.imm, inst.imm2, true);
            case Op::Param:
                return params_;
            case Op::ArrayLoad:
                return array_active_[static_cast<size_t>(inst.imm)];
            case Op::LoopVar:
                return of(inst.a) | of(next_of(v));
            case Op::Result:
                return result_activity(inst);
            case Op::Floor:
            case Op::Ceil:
            case Op::Trunc:
            case Op::Round:
            case Op::RecordField:
            case Op::RecordUniform:
            case Op::Du:  // the derivative of a derivative is 0
            case Op::Dv:
                return 0;
            case Op::WithSlope:
                return of(inst.b);
            // All others pass on what reaches their operands.
            // clang-format off
            case Op::ConstF: case Op::ConstI: case Op::ConstM: case Op::FrameLoad:
            case Op::FrameGather: case Op::Lookup: case Op::Add: case Op::Sub: case Op::Mul:
            case Op::Div: case Op::Fma: case Op::Min: case Op::Max: case Op::Neg: case Op::Abs:
            case Op::Sqrt: case Op::IAdd: case Op::ISub: case Op::IMul: case Op::IAnd:
            case Op::IOr: case Op::IXor: case Op::IShl: case Op::IShr: case Op::ISar:
            case Op::IMin: case Op::IMax: case Op::FToI: case Op::IToF: case Op::BitsFI:
            case Op::BitsIF: case Op::Lt: case Op::Le: case Op::Eq: case Op::ILt: case Op::IEq:
            case Op::MAnd: case Op::MOr: case Op::MXor: case Op::MAndNot: case Op::MNot:
            case Op::Select: case Op::RecordCount: case Op::ArrayStore: case Op::If:
            case Op::EndIf: case Op::Merge: case Op::Loop: case Op::EndLoop: case Op::LoopOut:
            case Op::Return: case Op::Call: case Op::Service: case Op::Fault:
                // clang-format on
                return of(inst.a) | of(inst.b) | of(inst.c);
            case Op::Count:
                break;
        }
        return 0;
    }

    // A row of inputs has partials where all of it has; "1" (the coordinate itself) is no row.
    uint8_t input_activity(int32_t first, int32_t count, bool row) const {
        uint8_t bits = kBoth;
        auto named = [&](const std::string& name) {
            return !name.empty() && (!row || name != "1");
        };
        for (int32_t k = first; k < first + count; ++k) {
            const InputInfo& input = m_.inputs[static_cast<size_t>(k)];
            if (!named(input.du)) bits &= static_cast<uint8_t>(~kAlongU);
            if (!named(input.dv)) bits &= static_cast<uint8_t>(~kAlongV);
        }
        return bits;
    }

    // Services have derivative 0.
    uint8_t result_activity(const Inst& inst) const {
        const Inst& call = f_.insts[inst.a];
        uint8_t bits = 0;
        if (call.op == Op::Call)
            for (Value arg : f_.args_of(call)) bits |= active_[arg];
        return bits;
    }

    void spread_need(Value v) {
        const Inst& inst = f_.insts[v];
        uint8_t bits = need_[v];
        switch (inst.op) {
            case Op::Du:
                return ask(inst.a, kAlongU);
            case Op::Dv:
                return ask(inst.a, kAlongV);
            case Op::WithSlope:
                return ask(inst.b, bits);
            case Op::Return:
                for (Value result : f_.args_of(inst)) ask(result, params_);
                return;
            case Op::ArrayLoad:
                return raise(array_need_[static_cast<size_t>(inst.imm)], bits);
            case Op::ArrayStore:
                return ask(inst.b, array_need_[static_cast<size_t>(inst.imm)]);
            case Op::LoopVar:
                ask(inst.a, bits);
                return ask(next_of(v), bits);
            case Op::Result:
                return ask_arguments(f_.insts[inst.a], bits);
            case Op::Call:
                if (asks_[static_cast<size_t>(inst.imm)]) ask_arguments(inst, kBoth);
                return;
            // All others pass on what reaches their operands.
            // clang-format off
            case Op::ConstF: case Op::ConstI: case Op::ConstM: case Op::Input:
            case Op::InputGather: case Op::FrameLoad: case Op::FrameGather: case Op::Lookup:
            case Op::Add: case Op::Sub: case Op::Mul: case Op::Div: case Op::Fma: case Op::Min:
            case Op::Max: case Op::Neg: case Op::Abs: case Op::Sqrt: case Op::Floor:
            case Op::Ceil: case Op::Trunc: case Op::Round: case Op::IAdd: case Op::ISub:
            case Op::IMul: case Op::IAnd: case Op::IOr: case Op::IXor: case Op::IShl:
            case Op::IShr: case Op::ISar: case Op::IMin: case Op::IMax: case Op::FToI:
            case Op::IToF: case Op::BitsFI: case Op::BitsIF: case Op::Lt: case Op::Le:
            case Op::Eq: case Op::ILt: case Op::IEq: case Op::MAnd: case Op::MOr: case Op::MXor:
            case Op::MAndNot: case Op::MNot: case Op::Select: case Op::RecordCount:
            case Op::RecordField: case Op::RecordUniform: case Op::If: case Op::EndIf:
            case Op::Merge: case Op::Loop: case Op::EndLoop: case Op::LoopOut: case Op::Param:
            case Op::Service: case Op::Fault:
                // clang-format on
                if (bits == 0) return;
                ask(inst.a, bits);
                ask(inst.b, bits);
                ask(inst.c, bits);
                return;
            case Op::Count:
                return;
        }
    }

    void ask(Value v, uint8_t bits) {
        if (v != kNone && f_.insts[v].type == Type::F) raise(need_[v], bits);
    }
    void ask_arguments(const Inst& call, uint8_t bits) {
        if (call.op == Op::Call)
            for (Value arg : f_.args_of(call)) ask(arg, bits);
    }

    const Module& m_;
    const Function& f_;
    uint8_t params_;
    const std::vector<bool>& asks_;
    std::vector<Value> match_;
    std::vector<uint8_t> active_, need_, array_active_, array_need_;
    bool changed_ = false;
};

}  // namespace

DerivativePlan plan_derivatives(const Module& module, const Function& function, uint8_t params,
                                const std::vector<bool>& asks) {
    return Planner(module, function, params, asks).run();
}

}  // namespace kinora::jit
