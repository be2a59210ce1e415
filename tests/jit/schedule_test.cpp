// tests/jit/schedule_test.cpp: what a loop's next round begins with is computed early, and only
// where that is right.
#include <gtest/gtest.h>

#include <algorithm>

#include "jit/compiler.h"
#include "jit/ir/builder.h"
#include "jit/passes/passes.h"

namespace kinora::jit {
namespace {

// A loop over x = 1, 2, 4, ... whose body works on what `use` makes of x.
struct LoopOverX {
    Module module;

    template <class Use>
    explicit LoopOverX(Use&& use) {
        add_function(module, "kernel", {});
        Builder b(module, 0);
        Value start = b.input({"x", Type::F, Rate::Point, "", ""});
        b.begin_loop(b.m(true), b.fault_site({}, "long"));
        Value x = b.loop_var(start), sum = b.loop_var(b.f(0)), count = b.loop_var(b.i(0));
        Value work = b.floor(x);
        for (int k = 0; k < 20; ++k) work = b.sqrt(b.add(work, b.f(1)));
        Value used = use(b, work, x);
        Value next[] = {b.mul(x, b.f(2)), b.add(sum, used), b.iadd(count, b.i(1))};
        b.end_loop(b.op(Op::ILt, next[2], b.i(8)), next);
        b.output({"sum", Type::F}, b.loop_out(sum));
        b.finish();
        schedule(module);
    }

    Value first(Op op) const {
        const std::vector<Inst>& insts = module.kernel().insts;
        auto at = std::find_if(insts.begin(), insts.end(), [op](auto& i) { return i.op == op; });
        return static_cast<Value>(at - insts.begin());
    }
};

TEST(Schedule, ComputesTheNextValueBehindTheLastRead) {
    LoopOverX loop([](Builder&, Value work, Value) { return work; });
    EXPECT_EQ(verify(loop.module), "");
    EXPECT_EQ(loop.first(Op::Mul), loop.first(Op::Floor) + 1) << print(loop.module);
}

TEST(Schedule, LeavesItWhereTheVariableIsReadAtTheEnd) {
    LoopOverX loop([](Builder& b, Value work, Value x) { return b.sub(work, x); });
    EXPECT_EQ(verify(loop.module), "");
    EXPECT_GT(loop.first(Op::Mul), loop.first(Op::Sub)) << print(loop.module);
}

TEST(Schedule, WaitsForAWholeIf) {
    LoopOverX loop([](Builder& b, Value work, Value x) {
        b.begin_if(b.lt(work, b.f(2)));
        Value inner = b.add(x, work);
        b.end_if();
        Value merged = b.merge(inner, work);
        for (int k = 0; k < 20; ++k) merged = b.sqrt(b.add(merged, b.f(1)));
        return merged;
    });
    EXPECT_EQ(verify(loop.module), "");
    EXPECT_EQ(loop.first(Op::Mul), loop.first(Op::Merge) + 1) << print(loop.module);
}

// x and y are exchanged each round: neither may move.
TEST(Schedule, LeavesVariablesThatOthersTakeOver) {
    Module module;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value start = b.input({"x", Type::F, Rate::Point, "", ""});
    b.begin_loop(b.m(true), b.fault_site({}, "long"));
    Value x = b.loop_var(start), y = b.loop_var(b.f(3)), count = b.loop_var(b.i(0));
    Value work = b.floor(y);
    for (int k = 0; k < 20; ++k) work = b.sqrt(b.add(work, b.f(1)));
    Value next[] = {b.mul(x, b.f(2)), x, b.iadd(count, b.i(1))};
    b.end_loop(b.op(Op::ILt, next[2], b.i(8)), next);
    b.output({"y", Type::F}, b.add(b.loop_out(y), b.loop_out(x)));
    b.finish();
    auto last = [&](Op op) {
        const std::vector<Inst>& insts = module.kernel().insts;
        return std::find_if(insts.rbegin(), insts.rend(), [op](auto& i) { return i.op == op; });
    };
    schedule(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_LT(last(Op::Mul) - last(Op::EndLoop), last(Op::Sqrt) - last(Op::EndLoop));
}

}  // namespace
}  // namespace kinora::jit
