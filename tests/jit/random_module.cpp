// tests/jit/random_module.cpp: grows a module instruction by instruction, without folding.
#include "tests/jit/random_module.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "tests/jit/world.h"

namespace kinora::jit::test {

const RandomPolicy kPolicies[] = {
    //           ifs loops calls services arrays records masks hashed functions
    {"plain", 3, 1, 1, 1, 2, 1, 10, 8, 1},   {"masks", 8, 2, 1, 2, 2, 1, 50, 8, 1},
    {"spills", 1, 1, 1, 1, 1, 1, 10, 60, 1}, {"loops", 3, 8, 2, 1, 4, 2, 15, 8, 2},
    {"calls", 3, 2, 8, 6, 3, 1, 15, 10, 4},  {"memory", 6, 12, 6, 1, 45, 12, 10, 12, 2},
};
const int kPolicyCount = static_cast<int>(std::size(kPolicies));

using Limits = std::numeric_limits<float>;
const float kEdgeFloats[] = {
    0.0f,
    -0.0f,
    1.0f,
    -1.0f,
    0.5f,
    -0.5f,
    1.5f,
    2.5f,
    -2.5f,
    3.0f,
    1e-40f,
    -Limits::denorm_min(),
    Limits::min(),
    Limits::max(),
    -Limits::max(),
    Limits::infinity(),
    -Limits::infinity(),
    Limits::quiet_NaN(),
    8388609.0f,
    2147483648.0f,
    -2147483648.0f,
    1.00000012f,
};
const int kEdgeFloatCount = static_cast<int>(std::size(kEdgeFloats));
const int32_t kEdgeInts[] = {
    0,          1,          -1,        2,         3,          7,
    -8,         31,         255,       65536,     0x7fffffff, std::numeric_limits<int32_t>::min(),
    0x3f800000, 0x7f800000, 123456789, -987654321};
const int kEdgeIntCount = static_cast<int>(std::size(kEdgeInts));

namespace {

// Ops that a random program may use freely, by what they give.
struct PureOps {
    std::vector<Op> all, masky;
    PureOps() {
        for (int k = 0; k < static_cast<int>(Op::Count); ++k) {
            Op op = static_cast<Op>(k);
            const OpInfo& info = op_info(op);
            bool plain = (info.flags & kPure) && info.operand_count > 0 && op != Op::Du &&
                         op != Op::Dv && op != Op::WithSlope && op != Op::InputGather &&
                         op != Op::FrameGather && op != Op::Lookup && op != Op::BitsFI;
            if (!plain) continue;
            all.push_back(op);
            if (info.result == 'M' || info.operands[0] == 'M') masky.push_back(op);
        }
    }
};

class Grower {
  public:
    Grower(uint64_t seed, const RandomPolicy& policy, int size)
        : policy_(policy), size_(size), rng_(seed) {}

    Module grow() {
        declare_world(m_);
        m_.name = policy_.name;
        m_.loop_budget = chance(10) ? 3 : 1000;
        m_.fault_sites = {{{}, "loop"}, {{}, "fault 1"}, {{}, "fault 2"}};
        m_.functions.resize(static_cast<size_t>(policy_.functions) + 1);
        for (size_t k = m_.functions.size(); k-- > 0;) grow_function(k);
        return std::move(m_);
    }

  private:
    int below(int n) { return static_cast<int>(rng_() % static_cast<uint64_t>(n)); }
    bool chance(int percent) { return below(100) < percent; }

    // Values visible now, by type.
    std::vector<Value>& pool(Type type) { return pools_[static_cast<int>(type)]; }
    Value any(Type type) {
        std::vector<Value>& values = pool(type);
        if (values.empty() || chance(5)) return constant(type);
        // Recent values more often, so that programs are deep.
        size_t n = values.size();
        size_t window = chance(50) ? std::min<size_t>(n, 6) : n;
        return values[n - 1 - static_cast<size_t>(below(static_cast<int>(window)))];
    }
    Type any_type() { return static_cast<Type>(1 + below(3)); }

    Value append(Inst inst, std::span<const Value> args = {}) {
        inst.args = static_cast<uint32_t>(f_->args.size());
        inst.arg_count = static_cast<uint16_t>(args.size());
        if (args.empty()) inst.args = 0;
        f_->args.insert(f_->args.end(), args.begin(), args.end());
        f_->insts.push_back(inst);
        auto v = static_cast<Value>(f_->insts.size() - 1);
        if (inst.type != Type::None) pool(inst.type).push_back(v);
        return v;
    }
    Value op(Op op, Type type, Value a, Value b = kNone, Value c = kNone, int32_t imm = 0) {
        return append({.op = op, .type = type, .a = a, .b = b, .c = c, .imm = imm});
    }

    Value constant(Type type) {
        if (type == Type::F) {
            float value = chance(50) ? kEdgeFloats[below(kEdgeFloatCount)]
                                     : static_cast<float>(below(2001) - 1000) / 64.0f;
            return append({.op = Op::ConstF, .type = type, .imm = bits_of(value)});
        }
        if (type == Type::I) {
            int32_t value = chance(50) ? kEdgeInts[below(kEdgeIntCount)] : below(16);
            return append({.op = Op::ConstI, .type = type, .imm = value});
        }
        return append({.op = Op::ConstM, .type = type, .imm = below(2)});
    }
    Value const_i(int32_t value) {
        return append({.op = Op::ConstI, .type = Type::I, .imm = value});
    }

    void grow_function(size_t index) {
        index_ = index;
        f_ = &m_.functions[index];
        for (auto& p : pools_) p.clear();
        f_->name = index == 0 ? "kernel" : "f" + std::to_string(index);
        if (index > 0) grow_params();
        for (int k = chance(policy_.arrays) ? 1 + below(2) : below(3); k > 0; --k)
            f_->arrays.push_back(
                {"a", chance(50) ? Type::F : Type::I, 1 + below(chance(50) ? 2 : 5)});
        if (index == 0) grow_inputs();
        for (Value& v : small_) v = const_i(static_cast<int32_t>(&v - small_));
        budget_ = index == 0 ? size_ : std::min(size_ / 3, 60);
        region_depth_ = 0;
        while (budget_ > 0) step();
        index == 0 ? finish_kernel() : finish_callee();
    }

    // Values that no folding sees through, so that little of a program is constant.
    void grow_inputs() {
        running_ = append({.op = Op::ConstM, .type = Type::M, .imm = 1});
        for (size_t k = 0; k < m_.inputs.size(); ++k)
            append({.op = Op::Input, .type = m_.inputs[k].type, .imm = static_cast<int32_t>(k)});
        for (int k = 0; k < 3; ++k) op(Op::Lt, Type::M, any(Type::F), any(Type::F));
    }

    // The first parameter is the mask for effects.
    void grow_params() {
        f_->params = {Type::M};
        for (int k = 1 + below(3); k > 0; --k) f_->params.push_back(any_type());
        for (size_t k = 0; k < f_->params.size(); ++k) {
            Value v =
                append({.op = Op::Param, .type = f_->params[k], .imm = static_cast<int32_t>(k)});
            if (k == 0) running_ = v;
        }
        for (int k = 1 + below(2); k > 0; --k) f_->results.push_back(any_type());
    }

    void step() {
        --budget_;
        int dice = below(100);
        auto takes = [&](int share) {
            dice -= share;
            return dice < 0;
        };
        if (takes(policy_.ifs)) return grow_if();
        if (takes(policy_.loops)) return grow_loop();
        if (takes(policy_.calls)) return grow_call();
        if (takes(policy_.services)) return grow_service();
        if (takes(policy_.arrays)) return grow_array();
        if (takes(policy_.records)) return grow_record();
        if (takes(8)) return grow_input();
        if (takes(2)) return grow_fault();
        if (takes(3)) return grow_bits();
        grow_pure();
    }

    void grow_pure() {
        static const PureOps ops;
        const auto& list = chance(policy_.masks) ? ops.masky : ops.all;
        Op o = list[static_cast<size_t>(below(static_cast<int>(list.size())))];
        const OpInfo& info = op_info(o);
        Type type = info.result == 'T' ? any_type() : type_of_letter(info.result);
        Inst inst{.op = o, .type = type};
        Value* operands[] = {&inst.a, &inst.b, &inst.c};
        for (int k = 0; k < info.operand_count; ++k) {
            Type wanted = type_of_letter(info.operands[k]);
            *operands[k] = any(wanted == Type::None ? type : wanted);
        }
        if (o == Op::Fma && chance(50)) {  // negated operands are part of what targets emit
            Value& operand = *operands[below(3)];
            operand = op(Op::Neg, Type::F, operand);
        }
        if (o == Op::IShl || o == Op::IShr || o == Op::ISar) inst.imm = below(32);
        append(inst);
    }

    // No NaN reaches an int op: which NaN it is is not promised.
    Value bits_of_value(Value x) {
        Value is_number = op(Op::Eq, Type::M, x, x);
        Value zero = append({.op = Op::ConstF, .type = Type::F, .imm = 0});
        return op(Op::BitsFI, Type::I, op(Op::Select, Type::F, is_number, x, zero));
    }
    void grow_bits() { bits_of_value(any(Type::F)); }

    void grow_lookup() {
        int32_t mask = chance(50) ? 7 : 15;
        append({.op = Op::Lookup,
                .type = Type::F,
                .a = any(Type::I),
                .imm = below(static_cast<int>(m_.table.size()) - mask),
                .imm2 = mask});
    }

    void grow_input() {
        if (index_ > 0) return grow_pure();
        if (chance(15)) return grow_lookup();
        int k = below(static_cast<int>(m_.inputs.size()));
        Type type = m_.inputs[static_cast<size_t>(k)].type;
        if (chance(70)) {
            append({.op = Op::Input, .type = type, .imm = k});
            return;
        }
        int first = chance(50) ? kPointArray : kFrameArray;
        append({.op = Op::InputGather,
                .type = m_.inputs[static_cast<size_t>(first)].type,
                .a = any(Type::I),
                .imm = first,
                .imm2 = kArrayInputs});
    }

    Value submask() { return op(Op::MAnd, Type::M, running_, any(Type::M)); }

    void grow_fault() { op(Op::Fault, Type::None, submask(), kNone, kNone, 1 + below(2)); }

    struct Scope {
        size_t sizes[4];
        Value running;
    };
    Scope enter_scope() {
        Scope scope{};
        for (int t = 1; t < 4; ++t) scope.sizes[t] = pools_[t].size();
        scope.running = running_;
        ++region_depth_;
        return scope;
    }
    // Gives back what was defined inside, newest last.
    std::vector<Value> leave(const Scope& scope) {
        std::vector<Value> inner;
        for (int t = 1; t < 4; ++t) {
            inner.insert(inner.end(), pools_[t].begin() + static_cast<long>(scope.sizes[t]),
                         pools_[t].end());
            pools_[t].resize(scope.sizes[t]);
        }
        running_ = scope.running;
        --region_depth_;
        return inner;
    }
    void grow_body() {
        int steps = 1 + below(12);
        for (int k = 0; k < steps && budget_ > 0; ++k) step();
    }

    // The value of an outer arm must exist before the If: constants made on the way do not.
    Value outer(const Scope& scope, Type type) {
        const std::vector<Value>& values = pools_[static_cast<int>(type)];
        size_t n = scope.sizes[static_cast<int>(type)];
        return n == 0 ? kNone : values[static_cast<size_t>(below(static_cast<int>(n)))];
    }

    void grow_if() {
        if (region_depth_ > 3) return grow_pure();
        grow_if_of(chance(10) ? running_ : submask());
    }
    // Effects inside are for lanes that run here.
    void grow_if_of(Value mask) {
        Scope scope = enter_scope();
        auto begin = op(Op::If, Type::None, mask);
        running_ = op(Op::MAnd, Type::M, mask, running_);
        grow_body();
        std::vector<Value> inner = leave(scope);
        op(Op::EndIf, Type::None, kNone, kNone, kNone, static_cast<int32_t>(begin));
        for (int k = 1 + below(3); k > 0 && !inner.empty(); --k) {
            Value a = inner[static_cast<size_t>(below(static_cast<int>(inner.size())))];
            Type type = f_->insts[a].type;
            Value b = outer(scope, type);
            if (b != kNone) op(Op::Merge, type, a, b, kNone, static_cast<int32_t>(begin));
        }
    }

    // A counter ends the loop; a random mask lets lanes leave before.
    void grow_loop() {
        if (region_depth_ > 2) return grow_pure();
        Value mask = submask();
        Value zero = const_i(0);
        Value limit = const_i(1 + below(5));
        Value one = const_i(1);
        std::vector<Value> inits = {zero};
        for (int k = below(4); k > 0; --k) inits.push_back(any(any_type()));
        Scope scope = enter_scope();
        Value begin = op(Op::Loop, Type::M, mask);
        running_ = begin;
        std::vector<Value> vars;
        for (Value init : inits)
            vars.push_back(op(Op::LoopVar, f_->insts[init].type, init, kNone, kNone,
                              static_cast<int32_t>(begin)));
        grow_body();
        std::vector<Value> next = {op(Op::IAdd, Type::I, vars[0], one)};
        for (size_t k = 1; k < vars.size(); ++k) next.push_back(any(f_->insts[vars[k]].type));
        Value more = op(Op::ILt, Type::M, next[0], limit);
        if (chance(50)) more = op(Op::MAnd, Type::M, more, any(Type::M));
        if (chance(50)) more = op(Op::MAnd, Type::M, more, running_);
        append({.op = Op::EndLoop, .a = more, .imm = static_cast<int32_t>(begin)}, next);
        leave(scope);
        for (Value var : vars)
            if (chance(70)) op(Op::LoopOut, f_->insts[var].type, var);
    }

    // Lanes off the mask hold anything; only a select by the mask may be looked at.
    void use_results(Value mask, const std::vector<Type>& types, Value call) {
        std::vector<Value> results;
        Scope scope = enter_scope();
        for (size_t k = 0; k < types.size(); ++k)
            results.push_back(
                op(Op::Result, types[k], call, kNone, kNone, static_cast<int32_t>(k)));
        leave(scope);
        for (Value result : results) {
            Type type = f_->insts[result].type;
            Value other = any(type);
            op(Op::Select, type, mask, result, other);
        }
    }

    void grow_call() {
        if (index_ + 1 >= m_.functions.size()) return grow_pure();
        auto count = static_cast<int>(m_.functions.size() - index_ - 1);
        size_t callee = index_ + 1 + static_cast<size_t>(below(count));
        Value mask = chance(50) ? running_ : submask();
        std::vector<Value> args = {mask};
        for (size_t k = 1; k < m_.functions[callee].params.size(); ++k)
            args.push_back(any(m_.functions[callee].params[k]));
        Value call = append({.op = Op::Call, .a = mask, .imm = static_cast<int32_t>(callee)}, args);
        use_results(mask, m_.functions[callee].results, call);
    }

    void grow_service() {
        int slot = below(static_cast<int>(m_.services.size()));
        const ServiceInfo& info = m_.services[static_cast<size_t>(slot)];
        Value mask = chance(50) ? running_ : submask();
        std::vector<Value> args;
        for (Type type : info.params) args.push_back(any(type));
        Value call = append({.op = Op::Service, .a = mask, .imm = slot}, args);
        use_results(mask, info.results, call);
    }

    void grow_array() {
        if (f_->arrays.empty()) return grow_pure();
        int k = below(static_cast<int>(f_->arrays.size()));
        Type type = f_->arrays[static_cast<size_t>(k)].type;
        // Often an element that is used elsewhere too.
        Value index = chance(50) ? small_[below(2)] : any(Type::I);
        if (chance(50)) {
            op(Op::ArrayLoad, type, index, kNone, kNone, k);
            return;
        }
        Value value = any(type);
        Value mask = chance(50) ? running_ : submask();
        op(Op::ArrayStore, Type::None, index, value, mask, k);
    }

    // Constant sets and records agree in all lanes. Set 0 is empty: only its count is asked.
    void grow_record() {
        if (chance(35)) return grow_record_loop();
        op(Op::RecordCount, Type::I, small_[below(kRecordSets)]);
        Value full = small_[1 + below(kRecordSets - 1)];
        Value record = small_[below(2)];
        bool uniform = chance(50);
        op(uniform ? Op::RecordUniform : Op::RecordField, Type::F, full, record, kNone,
           below(kRecordFields));
    }

    // As lights are gone through: all lanes together, from 0 while below the count.
    void grow_record_loop() {
        if (region_depth_ > 2) return grow_pure();
        Value set = small_[below(kRecordSets)];
        Value count = op(Op::RecordCount, Type::I, set);
        Value enter = op(Op::ILt, Type::M, small_[0], count);
        std::vector<Value> inits = {small_[0]};
        for (int k = below(4); k > 0; --k) inits.push_back(any(any_type()));
        Value outer_running = running_;
        Scope scope = enter_scope();
        Value begin = op(Op::Loop, Type::M, enter);
        std::vector<Value> vars;
        for (Value init : inits)
            vars.push_back(op(Op::LoopVar, f_->insts[init].type, init, kNone, kNone,
                              static_cast<int32_t>(begin)));
        running_ = op(Op::MAnd, Type::M, outer_running, begin);
        for (int k = 1 + below(3); k > 0; --k) read_record(set, vars[0]);
        grow_body();
        std::vector<Value> next = {op(Op::IAdd, Type::I, vars[0], small_[1])};
        for (size_t k = 1; k < vars.size(); ++k) next.push_back(any(f_->insts[vars[k]].type));
        Value more = op(Op::ILt, Type::M, next[0], count);
        append({.op = Op::EndLoop, .a = more, .imm = static_cast<int32_t>(begin)}, next);
        leave(scope);
        for (Value var : vars)
            if (chance(70)) op(Op::LoopOut, f_->insts[var].type, var);
    }

    // A field; or an If on an int of the record, as on a light's kind.
    void read_record(Value set, Value record) {
        if (chance(60)) {
            op(chance(50) ? Op::RecordUniform : Op::RecordField, Type::F, set, record, kNone,
               below(kRecordFields));
            return;
        }
        Value kind = op(Op::RecordUniform, Type::I, set, record, kNone, below(kRecordFields));
        Value same = op(Op::IEq, Type::M, kind, const_i(chance(50) ? 0x3e800000 : 0));
        if (chance(50)) same = op(Op::MNot, Type::M, same);
        grow_if_of(same);
    }

    // An output that hangs on many values finds what a few would not.
    Value hash(int count) {
        Value h = const_i(17), factor = const_i(31);
        std::vector<Value> chosen;
        for (int k = 0; k < count; ++k) chosen.push_back(any(k % 3 == 2 ? Type::M : any_type()));
        for (Value v : chosen) {
            Type type = f_->insts[v].type;
            Value bits = v;
            if (type == Type::F) bits = bits_of_value(v);
            if (type == Type::M)
                bits = append({.op = Op::Select, .type = Type::I, .a = v, .b = factor, .c = h});
            h = op(Op::IXor, Type::I, op(Op::IMul, Type::I, h, factor), bits);
        }
        return h;
    }

    void finish_kernel() {
        Value h = hash(policy_.hashed);
        std::vector<Value> results = {h, any(Type::F), any(Type::F), any(Type::I)};
        m_.outputs = {{"hash", Type::I}, {"x", Type::F}, {"y", Type::F}, {"n", Type::I}};
        f_->results = {Type::I, Type::F, Type::F, Type::I};
        append({.op = Op::Return}, results);
    }

    void finish_callee() {
        std::vector<Value> results;
        for (Type type : f_->results) results.push_back(any(type));
        append({.op = Op::Return}, results);
    }

    const RandomPolicy& policy_;
    int size_;
    std::mt19937_64 rng_;
    Module m_;
    size_t index_ = 0;
    Function* f_ = nullptr;
    std::vector<Value> pools_[4];
    Value running_ = kNone;
    Value small_[kRecordSets] = {};  // the constants 0, 1, 2, at the function's start
    int budget_ = 0;
    int region_depth_ = 0;
};

}  // namespace

Module random_module(uint64_t seed, const RandomPolicy& policy, int size) {
    return Grower(seed, policy, size).grow();
}

}  // namespace kinora::jit::test
