// tests/jit/target_random.h: random modules that use every op, for comparing targets with interp.
#pragma once

#include <random>

#include "jit/ir/builder.h"

namespace kinora::jit::test {

inline constexpr int kFloatInputs = 4, kIntInputs = 3, kFrameSlots = 6, kRecords = 3, kFields = 3;

// Writes random code into functions of a module. Values are chosen from those in scope, recent
// ones more often; loops are short or end by the budget.
class RandomCode {
  public:
    RandomCode(Module& module, size_t function, std::mt19937& random)
        : m_(module), b_(module, function), random_(random) {}

    Builder& builder() { return b_; }

    void begin_kernel() {
        for (int k = 0; k < kFloatInputs; ++k)
            f_.push_back(b_.input({"f" + std::to_string(k), Type::F, Rate::Point, "", ""}));
        for (int k = 0; k < kIntInputs; ++k)
            i_.push_back(b_.input({"i" + std::to_string(k), Type::I, Rate::Point, "", ""}));
        m_.frame_slots = kFrameSlots;
        begin();
    }
    void begin_function(const std::vector<Type>& params) {
        for (Type t : params) of(t).push_back(b_.param(t));
        running_.push_back(m_values_[0]);  // the first parameter
        begin();
    }

    void code(int ops) {
        while (ops > 0) ops -= step(ops);
    }

    Value any(Type t) {
        auto& values = of(t);
        size_t n = values.size();
        size_t back = pick(2) ? pick(std::min<size_t>(n, 6)) : pick(n);
        return values[n - 1 - back];
    }
    size_t pick(size_t n) { return random_() % n; }

    std::vector<size_t> callees;  // functions that may be called
    bool calls = true;

  private:
    void begin() {
        const float floats[] = {0, 1, -1, 0.5f, 3.25f, -1e30f, 1e-40f, 7};
        const int ints[] = {0, 1, -1, 5, 100, -2147483647 - 1};
        f_.push_back(b_.f(floats[pick(8)]));
        f_.push_back(b_.f(floats[pick(8)]));
        i_.push_back(b_.i(ints[pick(6)]));
        i_.push_back(b_.i(static_cast<int>(pick(8))));
        m_values_.push_back(b_.lt(any(Type::F), any(Type::F)));
        m_values_.push_back(b_.m(true));
        if (pick(2)) array_ = b_.declare_array("a", Type::F, 1 + static_cast<int>(pick(5)));
        if (pick(4) == 0) mask_array_ = b_.declare_array("m", Type::M, 2);
    }

    std::vector<Value>& of(Type t) { return t == Type::F ? f_ : t == Type::I ? i_ : m_values_; }
    Type random_type() {
        const Type types[] = {Type::F, Type::F, Type::I, Type::M};
        return types[pick(4)];
    }
    void add(Value v) { of(b_.type(v)).push_back(v); }
    void use(Op op, Value a, Value b = kNone, Value c = kNone, int imm = 0, int imm2 = 0) {
        add(b_.op(op, a, b, c, imm, imm2));
    }
    Value f() { return any(Type::F); }
    Value i() { return any(Type::I); }
    Value m() { return any(Type::M); }

    int step(int ops) {
        switch (pick(34)) {
            case 0:
            case 1:
                use(Op::Add, f(), f());
                break;
            case 2:
                use(Op::Sub, f(), f());
                break;
            case 3:
            case 4:
                use(Op::Mul, f(), f());
                break;
            case 5:
                pick(2) ? use(Op::Div, f(), f()) : use(Op::Sqrt, f());
                break;
            case 6:
            case 7:
            case 8:
                random_fma();
                break;
            case 9:
                use(pick(2) ? Op::Min : Op::Max, f(), f());
                break;
            case 10:
                use(pick(2) ? Op::Neg : Op::Abs, f());
                break;
            case 11: {
                const Op ops4[] = {Op::Floor, Op::Ceil, Op::Trunc, Op::Round};
                use(ops4[pick(4)], f());
                break;
            }
            case 12:
            case 13: {
                const Op ops8[] = {Op::IAdd, Op::ISub, Op::IMul, Op::IAnd,
                                   Op::IOr,  Op::IXor, Op::IMin, Op::IMax};
                use(ops8[pick(8)], i(), i());
                break;
            }
            case 14: {
                const Op ops3[] = {Op::IShl, Op::IShr, Op::ISar};
                use(ops3[pick(3)], i(), kNone, kNone, static_cast<int>(pick(32)));
                break;
            }
            case 15:
                use(Op::FToI, f());
                break;
            case 16:
                use(Op::IToF, i());
                break;
            case 17: {  // the bits of a NaN are nobody's business
                Value x = f();
                use(Op::BitsFI, b_.select(b_.eq(x, x), x, b_.f(2)));
                break;
            }
            case 18:
                use(Op::BitsIF, i());
                break;
            case 19:
            case 20: {
                const Op ops3[] = {Op::Lt, Op::Le, Op::Eq};
                use(ops3[pick(3)], f(), f());
                break;
            }
            case 21:
                use(pick(2) ? Op::ILt : Op::IEq, i(), i());
                break;
            case 22:
            case 23: {
                const Op ops4[] = {Op::MAnd, Op::MOr, Op::MXor, Op::MAndNot};
                use(ops4[pick(4)], m(), m());
                break;
            }
            case 24:
                use(Op::MNot, m());
                break;
            case 25:
            case 26: {
                Type t = random_type();
                use(Op::Select, m(), any(t), any(t));
                break;
            }
            case 27:
                memory();
                break;
            case 28:
                array();
                break;
            case 29:
            case 30:
                return ops > 6 ? random_if(ops) : 0;
            case 31:
                return ops > 8 ? random_loop(ops) : 0;
            case 32:
                if (calls) call();
                break;
            default:
                b_.fault(b_.fault_site({}, "random"), running_mask());
                break;
        }
        return 1;
    }

    void random_fma() {
        auto maybe_negative = [&] {
            Value v = f();
            return pick(4) == 0 ? b_.neg(v) : v;
        };
        Value x = maybe_negative(), y = maybe_negative(), z = maybe_negative();
        add(b_.fma(x, y, z));
    }

    void memory() {
        Value set = b_.i(static_cast<int>(pick(2)));
        switch (pick(7)) {
            case 6: {
                std::vector<float> values;
                for (size_t k = 1 + pick(16); k-- > 0;) values.push_back(static_cast<float>(k) - 3);
                add(b_.lookup(values, i()));
                break;
            }
            case 0:
                add(b_.op(Op::FrameLoad, kNone, kNone, kNone, static_cast<int>(pick(kFrameSlots))));
                break;
            case 1:
                use(Op::FrameGather, pick(2) ? i() : b_.i(2), kNone, kNone, 1, 4);
                break;
            case 2:
                if (m_.inputs.empty()) return;
                add(b_.input_gather(0, kFloatInputs, pick(2) ? i() : b_.i(1)));
                break;
            case 3:
                use(Op::RecordCount, set);
                break;
            case 4:
                use(Op::RecordField, set, b_.i(static_cast<int>(pick(kRecords))), kNone,
                    static_cast<int>(pick(kFields)));
                break;
            default:
                use(Op::RecordUniform, set, b_.i(static_cast<int>(pick(kRecords))), kNone,
                    static_cast<int>(pick(kFields)));
                break;
        }
    }

    void array() {
        Value index = pick(3) ? i() : b_.i(1);
        if (mask_array_ >= 0 && pick(2)) {
            if (pick(2))
                use(Op::ArrayLoad, index, kNone, kNone, mask_array_);
            else
                b_.op(Op::ArrayStore, index, m(), running_mask(), mask_array_);
        } else if (array_ >= 0) {
            if (pick(2))
                use(Op::ArrayLoad, index, kNone, kNone, array_);
            else
                b_.op(Op::ArrayStore, index, f(), running_mask(), array_);
        }
    }

    // Effects take the running mask: lanes that are off have none.
    Value running_mask() { return pick(2) ? running() : b_.logical_and(running(), m()); }
    Value running() { return running_.empty() ? b_.m(true) : running_.back(); }

    struct Mark {
        size_t f, i, m;
    };
    Mark mark() { return {f_.size(), i_.size(), m_values_.size()}; }
    void release(Mark mark) {
        f_.resize(mark.f);
        i_.resize(mark.i);
        m_values_.resize(mark.m);
    }

    int random_if(int ops) {
        Value mask = b_.logical_and(running(), m());
        Mark outer = mark();
        b_.begin_if(mask);
        running_.push_back(mask);
        int inside = 1 + static_cast<int>(pick(static_cast<size_t>(std::min(ops / 2, 24))));
        code(inside);
        running_.pop_back();
        std::vector<std::pair<Value, Value>> pairs;
        auto choose = [&](Type t, std::vector<Value>& values, size_t before) {
            for (int k = static_cast<int>(pick(3)); k-- > 0;)
                pairs.push_back({any(t), values[pick(before)]});
        };
        choose(Type::F, f_, outer.f);
        choose(Type::I, i_, outer.i);
        choose(Type::M, m_values_, outer.m);
        release(outer);
        b_.end_if();
        for (auto [a, b] : pairs) add(b_.merge(a, b));
        return inside + 2;
    }

    int random_loop(int ops) {
        bool uniform = pick(2) != 0;
        Value limit = uniform ? b_.i(static_cast<int>(pick(5))) : b_.iand(i(), b_.i(7));
        Value enter =
            uniform ? b_.m(true) : b_.logical_and(running(), b_.op(Op::ILt, b_.i(0), limit));
        if (uniform && !running_.empty()) uniform = false, enter = running();
        std::vector<std::pair<Type, Value>> inits;
        for (int k = static_cast<int>(pick(5)); k-- > 0;) {
            Type t = random_type();
            inits.push_back({t, any(t)});
        }
        Mark outer = mark();
        Value running_now = b_.begin_loop(enter, b_.fault_site({}, "budget"));
        Value counter = b_.loop_var(b_.i(0));
        i_.push_back(counter);
        std::vector<Value> vars;
        for (auto [t, init] : inits) {
            vars.push_back(b_.loop_var(init));
            add(vars.back());
        }
        m_values_.push_back(running_now);
        running_.push_back(running_now);
        int inside = 1 + static_cast<int>(pick(static_cast<size_t>(std::min(ops / 2, 24))));
        code(inside);
        if (pick(3) == 0) {
            Value set = b_.i(static_cast<int>(pick(2)));
            use(Op::RecordField, set, counter, kNone, static_cast<int>(pick(kFields)));
        }
        running_.pop_back();
        std::vector<Value> next = {b_.iadd(counter, b_.i(1))};
        for (auto [t, init] : inits) next.push_back(any(t));
        Value again = b_.op(Op::ILt, next[0], limit);
        if (!uniform && pick(2)) again = b_.logical_and(again, m());
        if (pick(12) == 0) again = uniform ? b_.m(true) : m();
        b_.end_loop(again, next);
        release(outer);
        add(b_.loop_out(counter));
        for (Value v : vars)
            if (pick(2)) add(b_.loop_out(v));
        return inside + 4;
    }

    void call() {
        if (!callees.empty() && pick(2)) {
            size_t callee = callees[pick(callees.size())];
            std::vector<Value> args;
            for (Type t : m_.functions[callee].params) args.push_back(any(t));
            Value mask = running_mask();
            args[0] = mask;
            keep(mask, b_.call(callee, mask, args));
            return;
        }
        int slot = b_.declare_service({"mix", {Type::F, Type::I}, {Type::F, Type::I}, false});
        Value mask = running_mask();
        Value args[] = {f(), i()};
        keep(mask, b_.service(slot, mask, args));
    }
    // Results are free where the call did not run.
    void keep(Value mask, const std::vector<Value>& results) {
        for (Value v : results) add(b_.select(mask, v, any(b_.type(v))));
    }

    Module& m_;
    Builder b_;
    std::mt19937& random_;
    std::vector<Value> f_, i_, m_values_, running_;
    int array_ = -1, mask_array_ = -1;
};

// A kernel of about `ops` instructions, with functions of its own if `calls`.
inline Module random_target_module(uint32_t seed, int ops, bool calls) {
    std::mt19937 random(seed);
    Module module;
    module.name = "random" + std::to_string(seed);
    module.loop_budget = 12;
    add_function(module, "kernel", {});
    std::vector<size_t> callees;
    if (calls)
        for (int k = 0; k < 2; ++k) {
            size_t index = add_function(module, "f" + std::to_string(k), {Type::F, Type::M});
            RandomCode code(module, index, random);
            code.callees = callees;
            code.begin_function({Type::M, Type::F, Type::I, Type::M, Type::F});
            code.code(ops / 4);
            Value results[] = {code.any(Type::F), code.any(Type::M)};
            code.builder().ret(results);
            callees.push_back(index);
        }
    RandomCode code(module, 0, random);
    code.callees = callees;
    code.calls = calls;
    code.begin_kernel();
    code.code(ops);
    for (int k = 0; k < 6; ++k) {
        Type t = k < 3 ? Type::F : k < 5 ? Type::I : Type::M;
        Value v = code.any(t);
        Builder& b = code.builder();
        if (t == Type::M) v = b.select(v, b.f(1), b.f(2));
        b.output({"o" + std::to_string(k), b.type(v)}, v);
    }
    code.builder().finish();
    return module;
}

}  // namespace kinora::jit::test
