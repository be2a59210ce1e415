// jit/passes/differentiate.cpp: Du and Dv become forward-mode dual numbers.
//
// Each planned value is followed by its derivatives: loop variables, merges and arrays get a second
// of their kind, calls of functions without a rule go to a copy that takes and gives derivatives.
#include <algorithm>
#include <atomic>
#include <map>

#include "jit/ir/normalize.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/derivative_plan_p.h"
#include "jit/passes/derivative_rules_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

std::atomic<size_t> g_derivative_values{0};

constexpr int kDirections = 2;
bool has(uint8_t directions, int d) {
    return (directions >> d & 1) != 0;
}

// The module's functions and their differentiated copies.
struct Copies {
    Module& module;
    std::vector<bool> asks;  // holds a Du or Dv, itself or in what it calls
    std::map<std::pair<size_t, uint8_t>, size_t> copies;

    // Index of the function that takes and gives derivatives in `directions`.
    size_t get(size_t index, uint8_t directions);
};

class Differentiator {
  public:
    // `params`: the directions in which parameters and results carry derivatives.
    Differentiator(Copies& copies, size_t index, uint8_t params)
        : copies_(copies), m_(copies.module), index_(index), params_(params), b_(m_, index) {}

    void run() {
        plan_ = plan_derivatives(m_, f(), params_, copies_.asks);
        old_ = std::move(f().insts);
        old_args_ = std::move(f().args);
        f().insts = {};
        f().args = {};
        renamed_.assign(old_.size(), kNone);
        for (auto& duals : duals_) duals.assign(old_.size(), kNone);
        add_dual_arrays();
        copy_params();
        for (Value v = first_; v < old_.size();) v = step(v);
        normalize(f());
    }

  private:
    // A rule may add functions to the module, so no reference to this one is kept.
    Function& f() { return m_.functions[index_]; }

    Value append(Inst inst) {
        f().insts.push_back(inst);
        return static_cast<Value>(f().insts.size() - 1);
    }
    Value append(Inst inst, const std::vector<Value>& args) {
        inst.args = static_cast<uint32_t>(f().args.size());
        inst.arg_count = static_cast<uint16_t>(args.size());
        f().args.insert(f().args.end(), args.begin(), args.end());
        return append(inst);
    }
    std::span<const Value> old_args_of(const Inst& inst) const {
        return {old_args_.data() + inst.args, inst.arg_count};
    }
    Value renamed(Value v) const { return v == kNone ? kNone : renamed_[v]; }
    Dual dual(int d, Value old) const {
        return old == kNone ? kNone : duals_[static_cast<size_t>(d)][old];
    }
    Value dual_or_zero(int d, Value old) {
        Dual known = dual(d, old);
        return known == kNone ? b_.f(0) : known;
    }
    void set_dual(int d, Value old, Dual value) {
        duals_[static_cast<size_t>(d)][old] = value;
        if (value != kNone) g_derivative_values.fetch_add(1, std::memory_order_relaxed);
    }

    Inst translate(Value v) const {
        Inst inst = old_[v];
        inst.a = renamed(inst.a);
        inst.b = renamed(inst.b);
        inst.c = renamed(inst.c);
        if (names_region(inst.op))
            inst.imm = static_cast<int32_t>(renamed_[static_cast<Value>(inst.imm)]);
        return inst;
    }
    void copy(Value v) {
        Inst inst = translate(v);
        std::vector<Value> args;
        for (Value arg : old_args_of(old_[v])) args.push_back(renamed_[arg]);
        renamed_[v] = args.empty() ? append(inst) : append(inst, args);
    }

    void add_dual_arrays() {
        for (int d = 0; d < kDirections; ++d) {
            size_t count = plan_.arrays.size();
            dual_arrays_[d].assign(count, -1);
            for (size_t k = 0; k < count; ++k) {
                if (!has(plan_.arrays[k], d)) continue;
                ArrayInfo array = f().arrays[k];
                array.name += d == 0 ? ".du" : ".dv";
                dual_arrays_[d][k] = static_cast<int32_t>(f().arrays.size());
                f().arrays.push_back(std::move(array));
            }
        }
    }

    // Parameters' derivatives follow all parameters: of the first in each direction, of the next...
    void copy_params() {
        for (first_ = 0; first_ < old_.size() && old_[first_].op == Op::Param; ++first_)
            copy(first_);
        if (params_ == 0) return;
        for (Value v = 0; v < first_; ++v)
            for (int d = 0; d < kDirections; ++d)
                if (old_[v].type == Type::F && has(params_, d)) set_dual(d, v, b_.param(Type::F));
    }

    Value step(Value v) {
        const Inst inst = old_[v];
        switch (inst.op) {
            case Op::Du:
                renamed_[v] = dual_or_zero(0, inst.a);
                return v + 1;
            case Op::Dv:
                renamed_[v] = dual_or_zero(1, inst.a);
                return v + 1;
            case Op::WithSlope:
                renamed_[v] = renamed(inst.a);
                for (int d = 0; d < kDirections; ++d)
                    if (has(plan_.values[v], d)) set_dual(d, v, dual_or_zero(d, inst.b));
                return v + 1;
            case Op::Call:
                return step_call(v);
            case Op::EndLoop:
                step_end_loop(v);
                return v + 1;
            case Op::Return:
                step_return(v);
                return v + 1;
            default:
                break;
        }
        copy(v);
        for (int d = 0; d < kDirections; ++d) {
            if (inst.op == Op::ArrayStore) store_dual(d, inst);
            if (has(plan_.values[v], d)) set_dual(d, v, dual_of(d, v));
        }
        return v + 1;
    }

    Dual dual_of(int d, Value v) {
        const Inst& inst = old_[v];
        switch (inst.op) {
            case Op::Input:
                return input_dual(d, inst);
            case Op::InputGather:
                return gather_dual(d, inst);
            case Op::ArrayLoad:
                return load_dual(d, inst);
            case Op::Merge:
            case Op::LoopVar: {
                Inst twin = translate(v);
                twin.a = dual_or_zero(d, inst.a);
                if (inst.op == Op::Merge) twin.b = dual_or_zero(d, inst.b);
                return append(twin);
            }
            case Op::LoopOut: {
                Inst twin = translate(v);
                twin.a = dual(d, inst.a);
                return append(twin);
            }
            default:
                return differentiate_op({b_,
                                         inst.op,
                                         {renamed(inst.a), renamed(inst.b), renamed(inst.c)},
                                         {dual(d, inst.a), dual(d, inst.b), dual(d, inst.c)},
                                         renamed_[v]});
        }
    }

    // An input's partial is an input of its own; "1" names the coordinate itself.
    static InputInfo partial(const InputInfo& input, int d) {
        return {.name = d == 0 ? input.du : input.dv,
                .type = Type::F,
                .rate = input.rate,
                .du = "",
                .dv = "",
                .key = d == 0 ? input.du_key : input.dv_key};
    }
    Dual input_dual(int d, const Inst& inst) {
        InputInfo input = partial(m_.inputs[static_cast<size_t>(inst.imm)], d);
        if (input.name == "1") return b_.f(1);
        return input.name.empty() ? kNone : b_.input(input);
    }
    // The partials of an array input stand in a row of their own; all or none are named.
    Dual gather_dual(int d, const Inst& inst) {
        auto first = static_cast<int32_t>(m_.inputs.size());
        for (int32_t k = 0; k < inst.imm2; ++k) {
            InputInfo input = partial(m_.inputs[static_cast<size_t>(inst.imm + k)], d);
            m_.inputs.push_back(std::move(input));
        }
        return b_.input_gather(first, inst.imm2, renamed(inst.a));
    }
    Dual load_dual(int d, const Inst& inst) {
        Inst twin = inst;
        twin.a = renamed(inst.a);
        twin.imm = dual_arrays_[d][static_cast<size_t>(inst.imm)];
        return append(twin);
    }
    void store_dual(int d, const Inst& inst) {
        int32_t array = dual_arrays_[d][static_cast<size_t>(inst.imm)];
        if (array < 0) return;
        Inst twin = inst;
        twin.a = renamed(inst.a);
        twin.b = dual_or_zero(d, inst.b);
        twin.c = renamed(inst.c);
        twin.imm = array;
        append(twin);
    }

    // Next values in the order in which the variables were written: each, then its derivatives.
    void step_end_loop(Value v) {
        Inst inst = translate(v);
        auto begin = static_cast<Value>(old_[v].imm);
        std::vector<Value> next;
        std::span<const Value> old_next = old_args_of(old_[v]);
        for (Value k = 0; k < old_next.size(); ++k) {
            next.push_back(renamed_[old_next[k]]);
            for (int d = 0; d < kDirections; ++d)
                if (dual(d, begin + 1 + k) != kNone) next.push_back(dual_or_zero(d, old_next[k]));
        }
        renamed_[v] = append(inst, next);
    }

    void step_return(Value v) {
        Inst inst = translate(v);
        std::vector<Value> results;
        std::span<const Value> old_results = old_args_of(old_[v]);
        for (Value result : old_results) results.push_back(renamed_[result]);
        size_t plain = results.size();
        for (size_t k = 0; k < plain; ++k)
            for (int d = 0; d < kDirections; ++d) {
                if (f().results[k] != Type::F || !has(params_, d)) continue;
                results.push_back(dual_or_zero(d, old_results[k]));
            }
        f().results.resize(results.size(), Type::F);
        append(inst, results);
    }

    Value step_call(Value v) {
        auto callee = static_cast<size_t>(old_[v].imm);
        Value end = v + 1;
        uint8_t directions = copies_.asks[callee] ? kAlongU | kAlongV : 0;
        while (old_[end].op == Op::Result) directions |= plan_.values[end++];
        const std::string name = m_.functions[callee].name;
        if (directions != 0 && !has_function_rule(name)) {
            call_copy(v, end, directions);
            return end;
        }
        for (Value k = v; k < end; ++k) copy(k);
        for (int d = 0; d < kDirections; ++d)
            if (has(directions, d)) apply_rule(d, v, name);
        return end;
    }

    void apply_rule(int d, Value call, const std::string& name) {
        std::vector<Value> x;
        std::vector<Dual> dx;
        for (Value arg : old_args_of(old_[call])) {
            x.push_back(renamed_[arg]);
            dx.push_back(dual(d, arg));
        }
        set_dual(d, call + 1, differentiate_function(b_, name, x, dx, renamed_[call + 1]));
    }

    void call_copy(Value v, Value end, uint8_t directions) {
        Inst inst = translate(v);
        inst.imm = static_cast<int32_t>(copies_.get(static_cast<size_t>(old_[v].imm), directions));
        std::span<const Value> old_args = old_args_of(old_[v]);
        std::vector<Value> args;
        for (Value arg : old_args) args.push_back(renamed_[arg]);
        for (Value arg : old_args)
            for (int d = 0; d < kDirections; ++d)
                if (old_[arg].type == Type::F && has(directions, d))
                    args.push_back(dual_or_zero(d, arg));
        renamed_[v] = append(inst, args);
        for (Value k = v + 1; k < end; ++k) copy(k);
        int32_t result = static_cast<int32_t>(end - v - 1);
        for (Value k = v + 1; k < end; ++k)
            for (int d = 0; d < kDirections; ++d) {
                if (old_[k].type != Type::F || !has(directions, d)) continue;
                set_dual(
                    d, k,
                    append({.op = Op::Result, .type = Type::F, .a = renamed_[v], .imm = result++}));
            }
    }

    Copies& copies_;
    Module& m_;
    size_t index_;
    uint8_t params_;
    Builder b_;
    DerivativePlan plan_;
    std::vector<Inst> old_;
    std::vector<Value> old_args_;
    std::vector<Value> renamed_;
    std::vector<Dual> duals_[kDirections];
    std::vector<int32_t> dual_arrays_[kDirections];
    Value first_ = 0;  // after the parameters
};

size_t Copies::get(size_t index, uint8_t directions) {
    auto [at, is_new] = copies.try_emplace({index, directions}, module.functions.size());
    if (!is_new) return at->second;
    size_t copy = at->second;
    module.functions.push_back(module.functions[index]);
    module.functions[copy].name += directions == 3 ? ".d" : directions == 1 ? ".du" : ".dv";
    Differentiator(*this, copy, directions).run();
    return copy;
}

bool holds(const Function& function, std::initializer_list<Op> ops) {
    for (const Inst& inst : function.insts)
        if (std::find(ops.begin(), ops.end(), inst.op) != ops.end()) return true;
    return false;
}

std::vector<bool> who_asks(const Module& module) {
    std::vector<bool> asks;
    for (const Function& function : module.functions)
        asks.push_back(holds(function, {Op::Du, Op::Dv}));
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t k = 0; k < asks.size(); ++k) {
            if (asks[k]) continue;
            for (const Inst& inst : module.functions[k].insts)
                if (inst.op == Op::Call && asks[static_cast<size_t>(inst.imm)]) asks[k] = true;
            changed |= asks[k];
        }
    }
    return asks;
}

}  // namespace

void differentiate(Module& module) {
    Copies copies{module, who_asks(module), {}};
    if (copies.asks[0]) Differentiator(copies, 0, 0).run();
    // Originals that ask for derivatives have lost their callers to their copies.
    for (size_t k = 0; k < module.functions.size(); ++k)
        if (holds(module.functions[k], {Op::Du, Op::Dv, Op::WithSlope}))
            Differentiator(copies, k, 0).run();
}

size_t derivative_values() {
    return g_derivative_values.load(std::memory_order_relaxed);
}

}  // namespace kinora::jit
