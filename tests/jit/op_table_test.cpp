// tests/jit/op_table_test.cpp: every arithmetic row of ops.def on edge values squared, on every
// target, against a scalar meaning written here once more.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "jit/ir/builder.h"
#include "jit/target.h"
#include "tests/jit/random_module.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::run_kernel;
using test::RunInput;

// Operand bits; masks are 0 or 1.
struct Operands {
    int32_t a, b, c;
    float fa() const { return float_of(a); }
    float fb() const { return float_of(b); }
    float fc() const { return float_of(c); }
    int64_t ua() const { return static_cast<uint32_t>(a); }
};
using Meaning = std::function<int32_t(const Operands&)>;
constexpr int kShift = 5;

int32_t f(double value) {
    return bits_of(static_cast<float>(value));
}
int32_t wrap(int64_t value) {
    return static_cast<int32_t>(static_cast<uint64_t>(value) & 0xffffffffu);
}
// Ties to even, by comparing the two neighbours.
double nearest_even(double x) {
    if (!std::isfinite(x) || std::abs(x) >= 1e15) return x;
    double low = std::floor(x), rest = x - low;
    double even = std::fmod(low, 2) == 0 ? low : low + 1;
    return std::copysign(rest < 0.5 ? low : rest > 0.5 ? low + 1 : even, x);
}

// A double holds the product of two floats exactly, and for + - * / and sqrt rounding to double and
// then to float is rounding once (53 >= 2 * 24 + 2). For a fused sum it is not: the double sum is
// made odd where it was inexact, after which rounding again is right (Boldo and Melquiond).
int32_t fused(const Operands& o) {
    double product = double(o.fa()) * double(o.fb()), c = o.fc();
    double sum = product + c;
    if (!std::isfinite(sum)) return f(sum);
    double back = sum - product;
    double error = (product - (sum - back)) + (c - back);
    bool odd = (std::bit_cast<uint64_t>(sum) & 1) != 0;
    if (error != 0 && !odd) sum = std::nextafter(sum, error > 0 ? INFINITY : -INFINITY);
    return f(sum);
}

const std::map<Op, Meaning>& meanings() {
    static const std::map<Op, Meaning> table = {
        {Op::Add, [](auto& o) { return f(double(o.fa()) + double(o.fb())); }},
        {Op::Sub, [](auto& o) { return f(double(o.fa()) - double(o.fb())); }},
        {Op::Mul, [](auto& o) { return f(double(o.fa()) * double(o.fb())); }},
        {Op::Div, [](auto& o) { return f(double(o.fa()) / double(o.fb())); }},
        {Op::Fma, fused},
        {Op::Min, [](auto& o) { return o.fa() < o.fb() ? o.a : o.b; }},
        {Op::Max, [](auto& o) { return o.fa() > o.fb() ? o.a : o.b; }},
        {Op::Neg, [](auto& o) { return wrap(o.ua() ^ 0x80000000); }},
        {Op::Abs, [](auto& o) { return wrap(o.ua() & 0x7fffffff); }},
        {Op::Sqrt, [](auto& o) { return f(std::sqrt(double(o.fa()))); }},
        {Op::Floor, [](auto& o) { return f(std::floor(double(o.fa()))); }},
        {Op::Ceil, [](auto& o) { return f(std::ceil(double(o.fa()))); }},
        {Op::Trunc, [](auto& o) { return f(std::trunc(double(o.fa()))); }},
        {Op::Round, [](auto& o) { return f(nearest_even(o.fa())); }},
        {Op::IAdd, [](auto& o) { return wrap(int64_t{o.a} + o.b); }},
        {Op::ISub, [](auto& o) { return wrap(int64_t{o.a} - o.b); }},
        {Op::IMul, [](auto& o) { return wrap(int64_t{o.a} * o.b); }},
        {Op::IAnd, [](auto& o) { return o.a & o.b; }},
        {Op::IOr, [](auto& o) { return o.a | o.b; }},
        {Op::IXor, [](auto& o) { return o.a ^ o.b; }},
        {Op::IShl, [](auto& o) { return wrap(o.ua() * (1 << kShift)); }},
        {Op::IShr, [](auto& o) { return wrap(o.ua() / (1 << kShift)); }},
        {Op::ISar,
         [](auto& o) { return static_cast<int32_t>(std::floor(double(o.a) / (1 << kShift))); }},
        {Op::IMin, [](auto& o) { return std::min(o.a, o.b); }},
        {Op::IMax, [](auto& o) { return std::max(o.a, o.b); }},
        {Op::FToI,
         [](auto& o) {
             double x = std::trunc(double(o.fa()));
             bool fits = x >= -2147483648.0 && x <= 2147483647.0;
             return fits ? static_cast<int32_t>(x) : INT32_MIN;
         }},
        {Op::IToF, [](auto& o) { return f(o.a); }},
        {Op::BitsFI, [](auto& o) { return o.a; }},
        {Op::BitsIF, [](auto& o) { return o.a; }},
        {Op::Lt, [](auto& o) { return int32_t{o.fa() < o.fb()}; }},
        {Op::Le, [](auto& o) { return int32_t{o.fa() <= o.fb()}; }},
        {Op::Eq, [](auto& o) { return int32_t{o.fa() == o.fb()}; }},
        {Op::ILt, [](auto& o) { return int32_t{o.a < o.b}; }},
        {Op::IEq, [](auto& o) { return int32_t{o.a == o.b}; }},
        {Op::MAnd, [](auto& o) { return o.a & o.b; }},
        {Op::MOr, [](auto& o) { return o.a | o.b; }},
        {Op::MXor, [](auto& o) { return o.a ^ o.b; }},
        {Op::MAndNot, [](auto& o) { return o.a & ~o.b & 1; }},
        {Op::MNot, [](auto& o) { return 1 - o.a; }},
        {Op::Select, [](auto& o) { return o.a != 0 ? o.b : o.c; }},
    };
    return table;
}

Type operand_type(const OpInfo& info, int k) {
    if (k >= info.operand_count) return Type::None;
    Type type = type_of_letter(info.operands[k]);
    return type == Type::None ? Type::F : type;
}

// Values to try for an operand: specials, as bits.
std::vector<int32_t> edge_bits(Type type) {
    std::vector<int32_t> list;
    if (type == Type::M) return {0, 1};
    if (type == Type::None) return {0};
    if (type == Type::F)
        for (int k = 0; k < test::kEdgeFloatCount; ++k)
            list.push_back(bits_of(test::kEdgeFloats[k]));
    else
        list.assign(test::kEdgeInts, test::kEdgeInts + test::kEdgeIntCount);
    return list;
}

// A kernel out = op(in0, in1, in2); masks enter and leave as ints.
Module op_module(Op op) {
    const OpInfo& info = op_info(op);
    Module module;
    module.name = info.name;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value operands[3] = {kNone, kNone, kNone};
    for (int k = 0; k < info.operand_count; ++k) {
        Type type = operand_type(info, k);
        bool mask = type == Type::M;
        operands[k] =
            b.input({"in" + std::to_string(k), mask ? Type::I : type, Rate::Point, "", ""});
        if (mask) operands[k] = b.op(Op::IEq, operands[k], b.i(1));
    }
    bool shifts = op == Op::IShl || op == Op::IShr || op == Op::ISar;
    Value result = b.op(op, operands[0], operands[1], operands[2], shifts ? kShift : 0);
    if (b.type(result) == Type::M) result = b.select(result, b.i(1), b.i(0));
    b.output({"out", b.type(result)}, result);
    b.finish();
    return module;
}

// All combinations of edge values, one a point.
RunInput edge_input(const OpInfo& info) {
    RunInput input;
    input.inputs.resize(static_cast<size_t>(info.operand_count));
    std::vector<int32_t> edges[3];
    for (int k = 0; k < 3; ++k) edges[k] = edge_bits(operand_type(info, k));
    for (int32_t a : edges[0])
        for (int32_t b : edges[1])
            for (int32_t c : edges[2]) {
                const int32_t bits[] = {a, b, c};
                for (size_t k = 0; k < input.inputs.size(); ++k) input.inputs[k].push_back(bits[k]);
            }
    input.count = static_cast<int32_t>(input.inputs[0].size());
    return input;
}

class OpTable : public testing::TestWithParam<const Target*> {};

TEST_P(OpTable, EveryRowMeansWhatItSays) {
    if (!GetParam()->supported()) GTEST_SKIP() << "this CPU lacks " << GetParam()->name;
    int rows = 0;
    for (const auto& [op, meaning] : meanings()) {
        SCOPED_TRACE(op_info(op).name);
        ++rows;
        auto kernel = GetParam()->emit(op_module(op), nullptr);
        ASSERT_NE(kernel, nullptr);
        RunInput input = edge_input(op_info(op));
        auto result = run_kernel(*kernel, input);
        int bad = 0;
        for (size_t p = 0; p < static_cast<size_t>(input.count) && bad < 5; ++p) {
            Operands o{input.inputs[0][p], 0, 0};
            if (input.inputs.size() > 1) o.b = input.inputs[1][p];
            if (input.inputs.size() > 2) o.c = input.inputs[2][p];
            int32_t wanted = meaning(o), got = result.out[0][p];
            if (test::same_bits(wanted, got, kernel->outputs[0].type)) continue;
            ++bad;
            ADD_FAILURE() << std::hex << "(" << o.a << ", " << o.b << ", " << o.c << ") gives "
                          << got << ", not " << wanted;
        }
    }
    EXPECT_GE(rows, 40);
}

TEST(OpTableRows, HasAMeaningForEveryPureRow) {
    for (size_t k = 0; k < static_cast<size_t>(Op::Count); ++k) {
        Op op = static_cast<Op>(k);
        bool loads = op == Op::InputGather || op == Op::FrameGather || op == Op::Lookup;
        bool derivative = op == Op::Du || op == Op::Dv || op == Op::WithSlope;
        if (!is_pure(op) || op_info(op).operand_count == 0 || loads || derivative) continue;
        EXPECT_EQ(meanings().count(op), 1u) << op_info(op).name;
    }
}

std::vector<const Target*> all_targets() {
    std::vector<const Target*> list;
    for (const Target& target : targets()) list.push_back(&target);
    return list;
}
INSTANTIATE_TEST_SUITE_P(Targets, OpTable, testing::ValuesIn(all_targets()),
                         [](const auto& row) { return std::string(row.param->name); });

}  // namespace
}  // namespace kinora::jit
