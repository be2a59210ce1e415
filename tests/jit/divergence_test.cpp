// tests/jit/divergence_test.cpp: what points of different ways cost, in counts: a way that no lane
// of a group takes is skipped, so no mixture of ways does more than each of them for all points.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "jit/ir/builder.h"
#include "jit/target.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

constexpr int kWays = 4;
constexpr int32_t kPoints = 16 * 20;

using Counts = std::array<int, kWays>;

// Called once for each group of lanes that runs the way, and for each round of its loop.
void count_way(const ServiceCall& call) {
    int lane = 0;
    while ((call.mask >> lane & 1) == 0) ++lane;
    int32_t way = bits_of(call.args[lane]);
    ++(*static_cast<Counts*>(call.grid))[static_cast<size_t>(way)];
    for (int k = 0; k < kMaxLanes; ++k) call.results[k] = 1;
}

// if (way < 1) ... else if (way < 2) ... as lowering writes it, each way a loop of `way + 2`
// rounds.
Module four_ways() {
    Module m;
    m.name = "ways";
    m.services = {{"count", {Type::I}, {Type::F}, false}};
    add_function(m, "kernel", {});
    Builder b(m, 0);
    Value way = b.ftoi(b.input({"way", Type::F, Rate::Point, "", ""}));
    Value rest = b.m(true), sum = b.f(0);
    for (int k = 0; k < kWays; ++k) {
        Value here = b.logical_and(rest, b.op(Op::IEq, way, b.i(k)));
        rest = b.and_not(rest, here);
        Value before = sum;
        b.begin_if(here);
        Value running = b.begin_loop(here, b.fault_site({}, "long"));
        Value round = b.loop_var(b.i(0)), part = b.loop_var(before);
        Value args[] = {b.i(k)};
        Value next_round = b.iadd(round, b.i(1));
        Value next[] = {next_round, b.add(part, b.service(0, running, args)[0])};
        b.end_loop(b.op(Op::ILt, next_round, b.i(k + 2)), next);
        Value inner = b.loop_out(part);
        b.end_if();
        sum = b.merge(inner, before);
    }
    b.output({"sum", Type::F}, sum);
    b.finish();
    return m;
}

// Calls by way, and that each point took its own.
template <class WayOf>
Counts counts_of(const Target& target, WayOf&& way_of) {
    Module module = four_ways();
    EXPECT_EQ(verify(module), "");
    auto kernel = target.emit(module, nullptr);
    Counts counts{};
    test::RunInput input;
    input.count = kPoints;
    input.services = {count_way};
    input.grid = &counts;
    std::vector<int32_t>& ways = input.inputs.emplace_back();
    for (int32_t p = 0; p < kPoints; ++p) ways.push_back(bits_of(static_cast<float>(way_of(p))));
    test::RunResult result = run_kernel(*kernel, input);
    for (int32_t p = 0; p < kPoints; ++p)
        EXPECT_EQ(float_of(result.out[0][static_cast<size_t>(p)]),
                  static_cast<float>(way_of(p) + 2))
            << target.name << ", point " << p;
    return counts;
}

TEST(Divergence, DoesNoMoreThanTheSumOfItsWays) {
    for (const Target& target : targets()) {
        if (!target.supported()) continue;
        Counts alone{};
        for (int k = 0; k < kWays; ++k) {
            Counts one = counts_of(target, [k](int32_t) { return k; });
            // Only its own way is entered, once a round by each group.
            alone[static_cast<size_t>(k)] = one[static_cast<size_t>(k)];
            EXPECT_EQ(one[static_cast<size_t>(k)], kPoints / target.lanes * (k + 2)) << target.name;
            EXPECT_EQ(std::accumulate(one.begin(), one.end(), 0), one[static_cast<size_t>(k)]);
        }
        Counts mixed = counts_of(target, [](int32_t p) { return (p * 7 + p / 5) % kWays; });
        for (size_t k = 0; k < kWays; ++k) EXPECT_LE(mixed[k], alone[k]) << target.name;
    }
}

TEST(Divergence, SkipsWaysThatNoLaneOfAGroupTakes) {
    for (const Target& target : targets()) {
        if (!target.supported()) continue;
        // Whole groups, of any target, take one way each: a quarter of the groups runs each way.
        Counts counts = counts_of(target, [](int32_t p) { return p / 16 % kWays; });
        for (int k = 0; k < kWays; ++k)
            EXPECT_EQ(counts[static_cast<size_t>(k)], kPoints / target.lanes / kWays * (k + 2))
                << target.name << ", way " << k;
    }
}

}  // namespace
}  // namespace kinora::jit
