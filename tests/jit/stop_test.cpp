// tests/jit/stop_test.cpp: long loops end once KernelArgs::stop is set, and are the same until
// then.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "jit/codegen/loop_slices_p.h"
#include "jit/compiler.h"
#include "jit/ir/builder.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::RunInput;
using test::RunResult;

const std::atomic<int> kStopped{1};

std::vector<const Target*> running_targets() {
    std::vector<const Target*> list;
    for (const Target& target : targets())
        if (target.supported()) list.push_back(&target);
    return list;
}

RunResult run_on(const Target& target, const Module& module, const RunInput& input) {
    EXPECT_EQ(verify(module), "") << print(module);
    return run_kernel(*target.emit(module, nullptr), input);
}

// k counts to x, or for ever; with a service in the body counters lie in memory.
Module counting(int32_t budget, bool endless, bool calls) {
    Module m;
    m.name = "counting";
    add_function(m, "kernel", {});
    m.loop_budget = budget;
    Builder b(m, 0);
    Value limit = b.input({"limit", Type::I, Rate::Point, "", ""});
    int note = calls ? b.declare_service({"note", {Type::I}, {}, false}) : 0;
    b.begin_loop(b.op(Op::ILt, b.i(0), limit), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0));
    Value next_k = b.iadd(k, b.i(1));
    if (calls) b.service(note, b.m(true), std::array{k});
    b.end_loop(endless ? b.m(true) : b.op(Op::ILt, next_k, limit), std::array{next_k});
    b.output({"k", Type::I}, b.loop_out(k));
    b.finish();
    return m;
}

RunInput limits(std::vector<int32_t> list) {
    RunInput in;
    in.count = int32_t(list.size());
    in.inputs = {std::move(list)};
    return in;
}

void ignore(const ServiceCall&) {}

// Counts where slices of 1024 rounds and less end, and budgets that end there; arithmetic by hand.
TEST(Stop, WhereNobodyStopsRoundsAreAsMany) {
    const std::vector<int32_t> list = {0,    1,    2,    64,   65,   66,   129,  1023, 1024, 1025,
                                       2047, 2048, 2049, 4999, 5000, 5001, 7000, 99,   3};
    for (int32_t budget : {1024, 1025, 2047, 2048, 2049, 5000, 1'000'000})
        for (bool calls : {false, true})
            for (const Target* target : running_targets()) {
                RunInput in = limits(list);
                if (calls) in.services = {ignore};
                RunResult result = run_on(*target, counting(budget, false, calls), in);
                bool beyond = false;
                for (size_t p = 0; p < list.size(); ++p) {
                    EXPECT_EQ(result.out[0][p], std::min(list[p], budget))
                        << target->name << " limit " << list[p] << " budget " << budget;
                    beyond |= list[p] > budget;
                }
                EXPECT_EQ(result.fault[0], int(beyond)) << target->name << " budget " << budget;
            }
}

TEST(Stop, AnEndlessLoopEndsAtItsFirstLookWithoutAFault) {
    for (bool calls : {false, true})
        for (const Target* target : running_targets()) {
            RunInput in = limits(std::vector<int32_t>(40, 1));
            if (calls) in.services = {ignore};
            in.stop = &kStopped;
            RunResult result = run_on(*target, counting(1'000'000, true, calls), in);
            for (int32_t k : result.out[0]) {
                EXPECT_GE(k, 1) << target->name;
                EXPECT_LE(k, calls ? 65 : 1024) << target->name;
            }
            EXPECT_EQ(result.fault[0], 0) << target->name;
        }
}

struct Stopper {
    std::atomic<int> stop{0};
    int calls = 0, after = 0;
};

void stop_at_third(const ServiceCall& call) {
    auto& stopper = *static_cast<Stopper*>(call.grid);
    stopper.after += stopper.stop;
    if (++stopper.calls == 3) stopper.stop = 1;
}

TEST(Stop, IsNoticedWhileALoopRuns) {
    for (const Target* target : running_targets()) {
        Stopper stopper;
        RunInput in = limits({1});
        in.services = {stop_at_third};
        in.grid = &stopper;
        in.stop = &stopper.stop;
        run_on(*target, counting(1'000'000, true, true), in);
        EXPECT_EQ(stopper.calls, 3 + stopper.after) << target->name;
        EXPECT_LE(stopper.after, 65) << target->name;
    }
}

// Three loops, one in the other, each of 1000 rounds that are known when it is compiled: a thousand
// million in all. The sum counts them.
Module cube(int32_t side) {
    Module m;
    m.name = "cube";
    add_function(m, "kernel", {});
    Builder b(m, 0);
    Value x = b.input({"x", Type::I, Rate::Point, "", ""});
    Value k[3], sum[3];
    for (int d = 0; d < 3; ++d) {
        b.begin_loop(b.m(true), b.fault_site({}, "budget"));
        k[d] = b.loop_var(b.i(0));
        sum[d] = b.loop_var(d == 0 ? x : sum[d - 1]);
    }
    Value inner = b.iadd(sum[2], b.i(1));
    for (int d = 2; d >= 0; --d) {
        Value next_k = b.iadd(k[d], b.i(1));
        b.end_loop(b.op(Op::ILt, next_k, b.i(side)), std::array{next_k, inner});
        inner = b.loop_out(sum[d]);
    }
    b.output({"sum", Type::I}, inner);
    b.finish();
    return m;
}

TEST(Stop, KnownRoundsThatAreManyTogetherEndToo) {
    for (const Target* target : running_targets()) {
        RunInput in = limits({5});
        EXPECT_EQ(run_on(*target, cube(30), in).out[0][0], 27005) << target->name;
        in.stop = &kStopped;
        EXPECT_EQ(run_on(*target, cube(3), in).out[0][0] > 5, true) << target->name;
        EXPECT_LE(run_on(*target, cube(1000), in).out[0][0], 20'000) << target->name;
    }
}

// What ends soon looks at nothing: its code is what it would be without the flag.
TEST(Stop, ShortLoopsHaveNoSlices) {
    auto sliced = [](const Module& m) {
        Structure structure(m.functions[0]);
        FunctionPlan plan = plan_function(m, m.functions[0], structure, {false, false, true});
        return std::count_if(plan.slices.begin(), plan.slices.end(),
                             [](int32_t s) { return s > 0; });
    };
    EXPECT_EQ(sliced(cube(3)), 0);
    EXPECT_EQ(sliced(cube(1000)), 2);  // the innermost is done within 65536 instructions
    EXPECT_EQ(sliced(counting(1000, false, false)), 0);
    EXPECT_EQ(sliced(counting(1'000'000, false, false)), 1);
}

}  // namespace
}  // namespace kinora::jit
