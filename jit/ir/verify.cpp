// jit/ir/verify.cpp: what a well-formed module promises, checked.
#include <fmt/format.h>

#include "jit/ir/analysis.h"
#include "jit/ir/ir.h"
#include "jit/ir/type_name_p.h"

namespace kinora::jit {

namespace {

// Checks one function; the first fault stops it.
class Verifier {
  public:
    Verifier(const Module& module, const Function& function) : m_(module), f_(function) {
        // scope_[v] = the open region that defines v, by its number; kClosed once it has ended.
        scope_.resize(f_.insts.size(), 0);
        end_of_.resize(f_.insts.size(), kNone);
        regions_.push_back({kNone, true});
        open_.push_back(0);
    }

    std::string run() {
        for (at_ = 0; at_ < f_.insts.size() && error_.empty(); ++at_) check(f_.insts[at_]);
        if (error_.empty() && open_.size() != 1) fail("a region is never closed");
        if (error_.empty() && (f_.insts.empty() || f_.insts.back().op != Op::Return))
            fail("the function does not end with a return");
        if (error_.empty() && params_ != f_.params.size()) fail("parameters are missing");
        return error_;
    }

  private:
    struct Region {
        Value begin;
        bool open;
        uint32_t vars = 0;
    };

    template <class... Args>
    void fail(fmt::string_view text, const Args&... args) {
        if (!error_.empty()) return;
        std::string what = fmt::vformat(text, fmt::make_format_args(args...));
        const char* op = at_ < f_.insts.size() ? op_info(f_.insts[at_].op).name : "end";
        error_ = fmt::format("{}: %{} {}: {}", f_.name, at_, op, what);
    }

    const Inst& previous() const { return f_.insts[at_ - 1]; }

    bool defined(Value v, const char* what) {
        if (v >= at_)
            return fail("{} %{} is not defined before", what, static_cast<int64_t>(v)), false;
        if (f_.insts[v].type == Type::None) return fail("{} %{} has no value", what, v), false;
        return true;
    }

    void use(Value v, Type wanted, const char* what) {
        if (!defined(v, what)) return;
        if (!regions_[scope_[v]].open) return fail("{} %{} is out of scope", what, v);
        if (f_.insts[v].type != wanted)
            fail("{} %{} is {}, not {}", what, v, type_name(f_.insts[v].type), type_name(wanted));
    }

    void range(int64_t value, size_t size, const char* what) {
        if (value < 0 || value >= static_cast<int64_t>(size))
            fail("{} {} is not in 0..{}", what, value, static_cast<int64_t>(size) - 1);
    }

    // The types a row states: 'T' operands are all of the result's type.
    void check_row(const Inst& inst) {
        const OpInfo& info = op_info(inst.op);
        Type result = type_of_letter(info.result);
        if (info.result == 'T' && inst.type == Type::None) fail("has no type");
        if (info.result != 'T' && inst.type != result)
            fail("gives {}, not {}", type_name(inst.type), type_name(result));
        const Value operands[] = {inst.a, inst.b, inst.c};
        constexpr const char* kNames[] = {"a", "b", "c"};
        for (int k = 0; k < 3; ++k) {
            if (k >= info.operand_count) {
                if (inst.op == Op::Result && k == 0) continue;
                if (operands[k] != kNone) fail("operand {} is not expected", kNames[k]);
                continue;
            }
            if (inst.op == Op::Merge || inst.op == Op::LoopOut) continue;  // their own scopes
            Type wanted = type_of_letter(info.operands[k]);
            if (wanted == Type::None) wanted = any_type(inst);
            use(operands[k], wanted, kNames[k]);
        }
        if (info.operands[0] == 0 || std::string_view(info.operands).back() != '*') {
            if (inst.arg_count != 0) fail("arguments are not expected");
        } else if (size_t{inst.args} + inst.arg_count > f_.args.size()) {
            fail("arguments lie outside the function's list");
        }
    }

    Type any_type(const Inst& inst) {
        if (inst.op != Op::ArrayStore) return inst.type;
        range(inst.imm, f_.arrays.size(), "array");
        return error_.empty() ? f_.arrays[static_cast<size_t>(inst.imm)].type : Type::F;
    }

    void check_args(const Inst& inst, const std::vector<Type>& types) {
        if (inst.arg_count != types.size())
            return fail("takes {} arguments, not {}", types.size(), inst.arg_count);
        for (size_t k = 0; k < types.size(); ++k) use(f_.args_of(inst)[k], types[k], "argument");
    }

    void check(const Inst& inst) {
        if (inst.op >= Op::Count) return fail("no such op");
        if (inst.where >= m_.locations.size()) return fail("location is out of range");
        if (call_ != kNone && inst.op != Op::Result) {
            if (result_next_ != call_results_->size())
                return fail("results of %{} are missing", call_);
            call_ = kNone;
        }
        scope_[at_] = open_.back();
        check_row(inst);
        if (error_.empty()) check_immediates(inst);
        if (error_.empty() && (op_info(inst.op).flags & (kControl | kEffect))) check_control(inst);
    }

    void check_immediates(const Inst& inst) {
        switch (inst.op) {
            case Op::Input:
                return check_inputs(inst, 1);
            case Op::InputGather:
                return check_inputs(inst, inst.imm2);
            case Op::FrameLoad:
                return check_slots(inst, 1);
            case Op::FrameGather:
                return check_slots(inst, inst.imm2);
            case Op::Lookup:
                if (inst.imm2 != 7 && inst.imm2 != 15) return fail("looks at {} bits", inst.imm2);
                range(inst.imm, m_.table.size(), "constant");
                return range(int64_t{inst.imm} + inst.imm2, m_.table.size(), "last constant");
            case Op::IShl:
            case Op::IShr:
            case Op::ISar:
                return range(inst.imm, 32, "shift count");
            case Op::RecordField:
            case Op::RecordUniform:
                return range(inst.imm, 65536, "field");
            case Op::ArrayLoad:
                range(inst.imm, f_.arrays.size(), "array");
                if (error_.empty() && f_.arrays[static_cast<size_t>(inst.imm)].type != inst.type)
                    fail("the array holds another type");
                return;
            case Op::Loop:
            case Op::Fault:
                return range(inst.imm, m_.fault_sites.size(), "fault site");
            case Op::Call:
                return range(inst.imm, m_.functions.size(), "function");
            case Op::Service:
                return range(inst.imm, m_.services.size(), "service");
            case Op::Param:
                return range(inst.imm, f_.params.size(), "parameter");
            default:
                return;
        }
    }

    void check_inputs(const Inst& inst, int32_t count) {
        if (count <= 0) return fail("gathers from {} inputs", count);
        range(inst.imm, m_.inputs.size(), "input");
        range(int64_t{inst.imm} + count - 1, m_.inputs.size(), "last input");
        for (int32_t k = 0; k < count && error_.empty(); ++k)
            if (m_.inputs[static_cast<size_t>(inst.imm + k)].type != inst.type)
                fail("input {} is of another type", inst.imm + k);
    }

    void check_slots(const Inst& inst, int32_t count) {
        if (count <= 0) return fail("gathers from {} slots", count);
        range(inst.imm, static_cast<size_t>(m_.frame_slots), "frame slot");
        range(int64_t{inst.imm} + count - 1, static_cast<size_t>(m_.frame_slots), "last slot");
    }

    void check_control(const Inst& inst) {
        switch (inst.op) {
            case Op::If:
            case Op::Loop:
                open_.push_back(static_cast<uint32_t>(regions_.size()));
                regions_.push_back({at_, true});
                // The Loop's mask and the LoopVars live inside.
                scope_[at_] = open_.back();
                return;
            case Op::EndIf:
                return check_end(inst, Op::If);
            case Op::EndLoop:
                return check_end(inst, Op::Loop);
            case Op::Merge:
                return check_merge(inst);
            case Op::LoopVar:
                return check_loop_var(inst);
            case Op::LoopOut:
                return check_loop_out(inst);
            case Op::Param:
                if (static_cast<size_t>(inst.imm) != params_++ || at_ != params_ - 1)
                    fail("parameters stand first, in order");
                if (f_.params[static_cast<size_t>(inst.imm)] != inst.type)
                    fail("the parameter is {}",
                         type_name(f_.params[static_cast<size_t>(inst.imm)]));
                return;
            case Op::Return:
                if (at_ + 1 != f_.insts.size() || open_.size() != 1)
                    fail("a return stands at the function's end only");
                return check_args(inst, f_.results);
            case Op::Call: {
                const Function& callee = m_.functions[static_cast<size_t>(inst.imm)];
                check_args(inst, callee.params);
                return expect_results(callee.results);
            }
            case Op::Service: {
                const ServiceInfo& info = m_.services[static_cast<size_t>(inst.imm)];
                check_args(inst, info.params);
                return expect_results(info.results);
            }
            case Op::Result:
                return check_result(inst);
            default:
                return;
        }
    }

    void check_end(const Inst& inst, Op begins) {
        Region& region = regions_[open_.back()];
        if (region.begin == kNone || f_.insts[region.begin].op != begins)
            return fail("no open {} to end", op_info(begins).name);
        if (static_cast<Value>(inst.imm) != region.begin)
            return fail("ends %{}, but %{} is open", inst.imm, region.begin);
        if (begins == Op::Loop) {
            if (inst.arg_count != region.vars)
                return fail("gives {} values for {} loop variables", inst.arg_count, region.vars);
            for (uint32_t k = 0; k < region.vars; ++k)
                use(f_.args_of(inst)[k], f_.insts[region.begin + 1 + k].type, "argument");
        }
        region.open = false;
        end_of_[region.begin] = at_;
        open_.pop_back();
    }

    void check_merge(const Inst& inst) {
        const Op op = at_ > 0 ? previous().op : Op::Return;
        if ((op != Op::EndIf && op != Op::Merge) || previous().imm != inst.imm)
            return fail("a merge follows its endif");
        auto begin = static_cast<Value>(inst.imm);
        Value end = end_of_[begin];
        if (!defined(inst.a, "a") || !defined(inst.b, "b")) return;
        if (f_.insts[inst.a].type != inst.type || f_.insts[inst.b].type != inst.type)
            return fail("arms are not both {}", type_name(inst.type));
        // The inner arm was visible at the end of the If, the outer one before it.
        bool inside = inst.a < end &&
                      (regions_[scope_[inst.a]].begin == begin || regions_[scope_[inst.a]].open);
        if (!inside) fail("a %{} is not visible at the end of the if", inst.a);
        if (inst.b > begin || !regions_[scope_[inst.b]].open)
            fail("b %{} is not visible before the if", inst.b);
    }

    void check_loop_var(const Inst& inst) {
        const Op op = at_ > 0 ? previous().op : Op::Return;
        Region& region = regions_[open_.back()];
        bool follows =
            (op == Op::Loop || op == Op::LoopVar) && static_cast<Value>(inst.imm) == region.begin;
        if (!follows) return fail("a loop variable follows its loop");
        if (inst.a >= region.begin)
            fail("the first value %{} is not defined before the loop", inst.a);
        ++region.vars;
    }

    void check_loop_out(const Inst& inst) {
        if (!defined(inst.a, "a")) return;
        if (f_.insts[inst.a].op != Op::LoopVar || f_.insts[inst.a].type != inst.type)
            return fail("%{} is no loop variable of type {}", inst.a, type_name(inst.type));
        Value end = end_of_[static_cast<Value>(f_.insts[inst.a].imm)];
        bool follows = end != kNone;
        for (Value k = at_ - 1; follows && k != end; --k) follows = f_.insts[k].op == Op::LoopOut;
        if (!follows) fail("a loop's results follow its endloop");
    }

    void expect_results(const std::vector<Type>& types) {
        call_ = at_;
        call_results_ = &types;
        result_next_ = 0;
    }

    void check_result(const Inst& inst) {
        if (call_ == kNone || inst.a != call_ || result_next_ == call_results_->size())
            return fail("follows no call that still gives results");
        if (static_cast<size_t>(inst.imm) != result_next_)
            return fail("results stand in order; {} comes next", result_next_);
        if ((*call_results_)[result_next_] != inst.type)
            fail("the result is {}", type_name((*call_results_)[result_next_]));
        ++result_next_;
    }

    const Module& m_;
    const Function& f_;
    Value at_ = 0;
    std::string error_;
    std::vector<uint32_t> scope_;
    std::vector<Value> end_of_;
    std::vector<Region> regions_;
    std::vector<uint32_t> open_;
    size_t params_ = 0;
    Value call_ = kNone;
    const std::vector<Type>* call_results_ = nullptr;
    size_t result_next_ = 0;
};

bool crosses(Type type) {
    return type == Type::F || type == Type::I;
}

// Floats and ints cross the kernel's border; masks go as ints.
std::string check_borders(const Module& module) {
    for (const InputInfo& input : module.inputs)
        if (!crosses(input.type)) return fmt::format("input {} is no float or int", input.name);
    for (const OutputInfo& output : module.outputs)
        if (!crosses(output.type)) return fmt::format("output {} is no float or int", output.name);
    for (const ServiceInfo& service : module.services)
        for (const std::vector<Type>* types : {&service.params, &service.results})
            for (Type type : *types)
                if (!crosses(type))
                    return fmt::format("service {} takes or gives a mask", service.name);
    return "";
}

}  // namespace

std::string verify(const Module& module) {
    if (module.functions.empty()) return "the module has no functions";
    if (!module.kernel().params.empty()) return "the kernel takes parameters";
    if (module.kernel().results.size() != module.outputs.size())
        return fmt::format("the kernel gives {} results for {} outputs",
                           module.kernel().results.size(), module.outputs.size());
    for (size_t k = 0; k < module.outputs.size(); ++k)
        if (module.outputs[k].type != module.kernel().results[k])
            return fmt::format("output {} is of another type than result {}",
                               module.outputs[k].name, k);
    if (std::string error = check_borders(module); !error.empty()) return error;
    for (const Function& function : module.functions) {
        std::string error = Verifier(module, function).run();
        if (!error.empty()) return error;
    }
    // Scratch memory is sized by the deepest chain of calls, so there must be one.
    std::vector<bool> cyclic = cyclic_functions(module);
    for (size_t k = 0; k < cyclic.size(); ++k)
        if (cyclic[k] && (module.call_depth < 1 || k == 0))
            return fmt::format("{}: calls itself", module.functions[k].name);
    return "";
}

}  // namespace kinora::jit
