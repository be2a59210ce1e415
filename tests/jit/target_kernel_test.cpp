// tests/jit/target_kernel_test.cpp: hand-written kernels on every target against the interpreter:
// every op on edge values, every count of points, loops at their budget, calls, records.
#include <gtest/gtest.h>

#include <cmath>

#include "jit/codegen/code_memory.h"
#include "jit/compiler.h"
#include "jit/math/math.h"
#include "tests/jit/random_module.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::RunInput;

InputInfo point(std::string name, Type type = Type::F) {
    return {std::move(name), type, Rate::Point, "", ""};
}

std::vector<const Target*> machines() {
    std::vector<const Target*> list;
    for (const Target& target : targets())
        if (std::string_view(target.name) != "interp" && target.supported())
            list.push_back(&target);
    return list;
}

void expect_same(const Module& module, const RunInput& input) {
    ASSERT_EQ(verify(module), "") << print(module);
    auto reference = find_target("interp")->emit(module, nullptr);
    auto expected = run_kernel(*reference, input);
    for (const Target* target : machines()) {
        auto kernel = target->emit(module, nullptr);
        ASSERT_NE(kernel, nullptr);
        EXPECT_EQ(difference(*kernel, expected, run_kernel(*kernel, input)), "")
            << target->name << ", " << input.count << " points\n"
            << print(module);
    }
}

Module one_function() {
    Module m;
    m.name = "test";
    add_function(m, "kernel", {});
    return m;
}

// All triples of edge values as three columns.
RunInput edge_triples(bool floats) {
    std::vector<int32_t> edges;
    if (floats)
        for (int k = 0; k < test::kEdgeFloatCount; ++k)
            edges.push_back(bits_of(test::kEdgeFloats[k]));
    else
        edges.assign(test::kEdgeInts, test::kEdgeInts + test::kEdgeIntCount);
    RunInput in;
    in.inputs.resize(6);
    for (int32_t a : edges)
        for (int32_t b : edges)
            for (int32_t c : edges) {
                in.inputs[0].push_back(a);
                in.inputs[1].push_back(b);
                in.inputs[2].push_back(c);
            }
    in.count = static_cast<int32_t>(in.inputs[0].size());
    for (int k = 3; k < 6; ++k) in.inputs[static_cast<size_t>(k)] = in.inputs[0];
    return in;
}

TEST(TargetOps, EveryPureOpOnEdgeValues) {
    for (int k = 0; k < static_cast<int>(Op::Count); ++k) {
        Op op = static_cast<Op>(k);
        const OpInfo& info = op_info(op);
        std::string operands = info.operands;
        bool floats = operands.find('F') != std::string::npos;
        if ((info.flags & kPure) == 0 || operands.empty() || op == Op::Du || op == Op::Dv ||
            op == Op::WithSlope || op == Op::InputGather || op == Op::FrameGather ||
            op == Op::Lookup || operands.find('M') == 0)
            continue;
        SCOPED_TRACE(info.name);
        Module m = one_function();
        Builder b(m, 0);
        Value in[3];
        for (int i = 0; i < 3; ++i)
            in[i] = b.input(
                point(std::string(1, static_cast<char>('a' + i)), floats ? Type::F : Type::I));
        for (int i = 0; i < 3; ++i) b.input(point("unused" + std::to_string(i)));
        bool shift = op == Op::IShl || op == Op::IShr || op == Op::ISar;
        if (op == Op::BitsFI) in[0] = b.select(b.eq(in[0], in[0]), in[0], b.f(0));
        for (int imm = 0; imm < (shift ? 32 : 1); ++imm) {
            size_t n = operands.size();
            Value v = b.op(op, in[0], n > 1 ? in[1] : kNone, n > 2 ? in[2] : kNone, imm);
            if (b.type(v) == Type::M) v = b.select(v, b.i(1), b.i(0));
            b.output({"r" + std::to_string(imm), b.type(v)}, v);
        }
        b.finish();
        expect_same(m, edge_triples(floats));
    }
}

// A walk of mixed inputs, different for each point.
RunInput wave(int32_t count, int inputs) {
    RunInput in;
    in.count = count;
    for (int k = 0; k < inputs; ++k) {
        auto& row = in.inputs.emplace_back();
        for (int p = 0; p < count; ++p)
            row.push_back(bits_of(3 * std::sin(static_cast<float>(p * (k + 2) + k))));
    }
    for (int k = 0; k < 8; ++k) in.frame.push_back(bits_of(0.25f * static_cast<float>(k)));
    return in;
}

TEST(TargetKernel, EveryCountOfPoints) {
    Module m = one_function();
    Builder b(m, 0);
    Value p[] = {b.input(point("x")), b.input(point("y")), b.input(point("z"))};
    Value noise = math::noise(b, b.m(true), p, 1)[0];
    Value s = math::sin(b, b.fma(noise, b.f(10), p[0]), math::Tier::Precise);
    b.output({"s", Type::F}, s);
    b.output({"pow", Type::F}, math::pow(b, b.abs(s), p[1], math::Tier::Precise));
    b.finish();
    for (int32_t count = 1; count <= 40; ++count) expect_same(m, wave(count, 3));
}

// Records summed in a loop that lanes leave one by one.
TEST(TargetKernel, RecordsInALoopThatLanesLeave) {
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x"));
    Value zero = b.i(0);
    Value count = b.op(Op::RecordCount, zero);
    Value running = b.begin_loop(b.op(Op::ILt, zero, count), b.fault_site({}, "budget"));
    Value k = b.loop_var(zero);
    Value sum = b.loop_var(b.f(0));
    Value field = b.op(Op::RecordField, zero, k, kNone, 0);
    Value uniform = b.op(Op::RecordUniform, zero, k, kNone, 1);
    Value next_sum = b.fma(field, uniform, sum);
    Value next_k = b.iadd(k, b.i(1));
    Value more = b.logical_and(b.op(Op::ILt, next_k, count), b.lt(next_sum, x));
    Value next[] = {next_k, next_sum};
    b.end_loop(b.logical_and(running, more), next);
    b.output({"sum", Type::F}, b.loop_out(sum));
    b.output({"k", Type::I}, b.loop_out(k));
    b.finish();

    alignas(64) float columns[5][48];
    const float* pointers[5][2];
    Record records[5];
    for (int r = 0; r < 5; ++r) {
        for (int p = 0; p < 48; ++p) columns[r][p] = static_cast<float>((p * 7 + r) % 5);
        pointers[r][0] = pointers[r][1] = columns[r];
        records[r] = {pointers[r], columns[r]};
    }
    for (int32_t lights : {0, 1, 5}) {
        RecordSet set = {lights, records};
        for (int32_t points : {1, 7, 8, 9, 16, 17, 33}) {
            RunInput in = wave(points, 1);
            in.record_sets = &set;
            expect_same(m, in);
        }
    }
}

// Variables of a loop that swap and rotate, also masks, and a mask that is the next mask.
TEST(TargetKernel, LoopVariablesChangeAtOnce) {
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x")), y = b.input(point("y")), z = b.input(point("z"));
    Value m1 = b.lt(x, y), m2 = b.lt(y, z);
    b.begin_loop(b.m(true), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0));
    Value v[] = {b.loop_var(x), b.loop_var(y), b.loop_var(z)};
    Value c[] = {b.loop_var(m1), b.loop_var(m2)};
    Value going = b.loop_var(b.m(true));
    Value next_k = b.iadd(k, b.i(1));
    Value next[] = {next_k,
                    v[1],
                    v[2],
                    v[0],
                    c[1],
                    c[0],
                    b.op(Op::ILt, next_k, b.ftoi(b.mul(b.abs(x), b.f(3))))};
    b.end_loop(going, next);
    for (int i = 0; i < 3; ++i) b.output({"v" + std::to_string(i), Type::F}, b.loop_out(v[i]));
    for (int i = 0; i < 2; ++i)
        b.output({"c" + std::to_string(i), Type::F}, b.select(b.loop_out(c[i]), b.f(1), b.f(0)));
    b.output({"k", Type::I}, b.loop_out(k));
    b.finish();
    for (int32_t count : {1, 8, 16, 23}) expect_same(m, wave(count, 3));
}

TEST(TargetKernel, AnEndlessLoopEndsWithItsFault) {
    Module m = one_function();
    m.loop_budget = 1000;
    Builder b(m, 0);
    Value x = b.input(point("x"));
    b.begin_loop(b.gt(x, b.f(0)), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0));
    Value next[] = {b.iadd(k, b.i(1))};
    b.end_loop(b.m(true), next);
    b.output({"k", Type::I}, b.loop_out(k));
    b.finish();
    RunInput in = wave(20, 1);
    expect_same(m, in);
    in.inputs[0].assign(20, bits_of(-1));
    expect_same(m, in);
}

// Every index, negative ones too; the value is also needed afterwards, or dies.
TEST(TargetKernel, LooksUpConstants) {
    for (size_t size : {1, 3, 8, 9, 13, 16}) {
        std::vector<float> values;
        for (size_t k = 0; k < size; ++k) values.push_back(1.5f * static_cast<float>(k) - 4);
        values[size / 2] = -0.0f;
        Module m = one_function();
        Builder b(m, 0);
        Value index = b.ftoi(b.mul(b.input(point("x")), b.f(7)));
        Value here = b.lookup(values, index);
        Value next = b.lookup(values, b.iadd(index, b.i(1)));
        b.output({"both", Type::F}, b.fma(here, b.f(100), next));
        b.output({"index", Type::I}, index);
        b.finish();
        for (int32_t count : {1, 23, 64}) expect_same(m, wave(count, 1));
        EXPECT_EQ(m.table.size(), size <= 8 ? 8u : 16u);
    }
}

// Loops whose rounds are known: up and down, floats and ints, the counter read or not, nested, cut
// short by the budget.
TEST(TargetKernel, CountsKnownRounds) {
    for (int32_t budget : {3, 1000})
        for (bool read : {false, true}) {
            Module m = one_function();
            m.loop_budget = budget;
            Builder b(m, 0);
            Value x = b.input(point("x"));
            b.begin_loop(b.m(true), b.fault_site({}, "outer"));
            Value k = b.loop_var(b.f(8)), sum = b.loop_var(x);
            b.begin_loop(b.m(true), b.fault_site({}, "inner"));
            Value j = b.loop_var(b.i(2)), inner = b.loop_var(sum);
            Value next_j = b.iadd(j, b.i(3));
            Value term = read ? b.mul(b.itof(j), k) : b.f(0.25f);
            Value inner_next[] = {next_j, b.fma(inner, b.f(0.5f), term)};
            b.end_loop(b.op(Op::ILt, next_j, b.i(9)), inner_next);
            Value next_k = b.sub(k, b.f(1.5f));
            Value next[] = {next_k, b.loop_out(inner)};
            b.end_loop(b.lt(b.f(0), next_k), next);
            b.output({"sum", Type::F}, b.loop_out(sum));
            if (read) b.output({"k", Type::F}, b.loop_out(k));
            b.finish();
            for (int32_t count : {1, 16, 23}) expect_same(m, wave(count, 1));
        }
}

// A conditional branch of AArch64 reaches 1 MiB: an If and a Loop here are longer.
TEST(TargetKernel, RegionsLongerThanABranchReaches) {
    constexpr int kLong = 270'000;
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x")), y = b.input(point("y"));
    Value count = b.ftoi(b.abs(y));
    b.begin_loop(b.op(Op::ILt, b.i(0), count), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0));
    Value sum = b.loop_var(y);
    b.begin_if(b.lt(sum, x));
    Value inner = sum;
    for (int i = 0; i < kLong; ++i) inner = b.fma(inner, b.f(0.99999f), x);
    b.end_if();
    Value next_k = b.iadd(k, b.i(1));
    Value next[] = {next_k, b.merge(inner, sum)};
    b.end_loop(b.op(Op::ILt, next_k, count), next);
    b.output({"sum", Type::F}, b.loop_out(sum));
    b.finish();
    expect_same(m, wave(9, 2));
}

// Constants, frame slots and array elements beyond what an instruction's offset holds.
TEST(TargetKernel, PlacesFarFromTheirBase) {
    constexpr int kMany = 5000;
    Module m = one_function();
    m.frame_slots = kMany;
    Builder b(m, 0);
    Value x = b.input(point("x"));
    Value sum = x;
    for (int i = 0; i < kMany; ++i) sum = b.fma(sum, b.f(0.5f), b.f(static_cast<float>(i) + 0.25f));
    int arrays[] = {b.declare_array("near", Type::F, kMany),
                    b.declare_array("far", Type::F, kMany)};
    Value index = b.iadd(b.ftoi(b.mul(x, b.f(100))), b.i(kMany - 1));
    for (int array : arrays) {
        b.op(Op::ArrayStore, b.i(kMany - 1), sum, b.m(true), array);
        b.op(Op::ArrayStore, index, b.op(Op::FrameLoad, kNone, kNone, kNone, kMany - 1),
             b.lt(x, b.f(1)), array);
        sum = b.add(sum, b.op(Op::ArrayLoad, b.i(kMany - 1), kNone, kNone, array));
        sum = b.add(sum, b.op(Op::ArrayLoad, index, kNone, kNone, array));
    }
    b.output({"sum", Type::F}, sum);
    b.finish();
    RunInput in = wave(20, 1);
    in.frame.assign(kMany, bits_of(7));
    expect_same(m, in);
}

// What is not cleared is what was stored, behind frames that are full of other numbers.
TEST(TargetKernel, ArraysAreClearedAsFarAsTheySay) {
    constexpr int kLength = 40, kCleared[] = {1, 0, 40, 3};
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x")), sum = b.f(0), mixed = x;
    for (int cleared : kCleared) {
        int array = b.declare_array("a" + std::to_string(cleared), Type::F, kLength, cleared);
        for (int k = 0; k < cleared; ++k)
            sum = b.add(sum, b.op(Op::ArrayLoad, b.i(k), kNone, kNone, array));
        for (int k = 0; k < kLength; ++k)
            b.op(Op::ArrayStore, b.i(k), b.add(x, b.f(float(k))), b.m(true), array);
        Value last = b.op(Op::ArrayLoad, b.i(kLength - 1), kNone, kNone, array);
        mixed = b.fma(mixed, b.f(0.5f), last);
    }
    b.output({"sum", Type::F}, sum);
    b.output({"mixed", Type::F}, mixed);
    b.finish();
    EXPECT_NE(print(m).find("f 40 cleared 1\n"), std::string::npos) << print(m);
    EXPECT_NE(print(m).find("f 40\n"), std::string::npos) << print(m);
    for (int again = 0; again < 2; ++again) expect_same(m, wave(33, 2));
}

// 2^32 bytes and more of arrays, which 32 bits would hold as few.
TEST(TargetKernel, FramesBeyondReachGiveNoKernelAndTellTheInterpreterTheirSize) {
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x"));
    Value sum = x;
    constexpr int kArrays = 5, kLength = 1 << 24;  // 1 GiB each at 16 lanes
    for (int k = 0; k < kArrays * 4; ++k) {
        int array = b.declare_array("a" + std::to_string(k), Type::F, kLength);
        b.op(Op::ArrayStore, b.ftoi(x), x, b.m(true), array);
        sum = b.add(sum, b.op(Op::ArrayLoad, b.ftoi(sum), kNone, kNone, array));
    }
    b.output({"y", Type::F}, sum);
    b.finish();
    ASSERT_EQ(verify(m), "");
    for (const Target* target : machines()) {
        EXPECT_EQ(target->emit(m, nullptr), nullptr) << target->name;
        EXPECT_EQ(target->check(m), "") << target->name;
    }
    EXPECT_GE(find_target("interp")->emit(m, nullptr)->scratch_bytes,
              size_t{kArrays} * 4 * kLength * 64);
}

TEST(TargetKernel, NoExecutableMemoryGivesNoKernel) {
    Module m = one_function();
    Builder b(m, 0);
    b.output({"x", Type::F}, b.input(point("x")));
    b.finish();
    deny_executable_memory(true);
    for (const Target* target : machines()) EXPECT_EQ(target->emit(m, nullptr), nullptr);
    deny_executable_memory(false);
}

TEST(TargetKernel, ListingNamesTheInstructions) {
    Module m = one_function();
    Builder b(m, 0);
    Value x = b.input(point("x"));
    b.output({"y", Type::F}, b.fma(x, x, x));
    b.finish();
    for (const Target* target : machines()) {
        std::string text;
        ASSERT_NE(target->emit(m, &text), nullptr);
        bool fma = text.find("vfmadd") != std::string::npos;
        EXPECT_TRUE(fma || text.find("fmla") != std::string::npos) << text;
        EXPECT_NE(text.find("Fma"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace kinora::jit
