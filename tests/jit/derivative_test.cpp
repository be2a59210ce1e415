// tests/jit/derivative_test.cpp: derivatives against central differences in double, by hand rules.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "jit/compiler.h"
#include "jit/math/math.h"
#include "jit/passes/passes.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::run_kernel;
using test::RunInput;
constexpr auto kPrecise = math::Tier::Precise;

// Inputs x and y; x is u itself, y has its partials in inputs of its own: y = 0.5 u - 2 v.
constexpr double kYu = 0.5, kYv = -2.0;

Value input_x(Builder& b) {
    return b.input({"x", Type::F, Rate::Point, "1", ""});
}
Value input_y(Builder& b) {
    return b.input({"y", Type::F, Rate::Point, "y:du", "y:dv"});
}

struct Derivatives {
    float value, du, dv;
};

// Du and Dv of what `body` makes of (x, y), at (x, y), through all passes.
Derivatives derive(const std::function<Value(Builder&, Value, Value)>& body, float x, float y) {
    Module module;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value result = body(b, input_x(b), input_y(b));
    b.output({"value", Type::F}, result);
    b.output({"du", Type::F}, b.op(Op::Du, result));
    b.output({"dv", Type::F}, b.op(Op::Dv, result));
    b.finish();
    EXPECT_EQ(verify(module), "") << print(module);
    differentiate(module);
    EXPECT_EQ(verify(module), "") << print(module);
    Module frame;
    optimize(module, &frame);
    EXPECT_EQ(verify(module), "") << print(module);
    auto kernel = find_target("interp")->emit(module, nullptr);
    RunInput input;
    for (const InputInfo& info : kernel->inputs) {
        double value = info.name == "x"      ? x
                       : info.name == "y"    ? y
                       : info.name == "y:du" ? kYu
                                             : kYv;
        input.inputs.push_back({bits_of(static_cast<float>(value))});
    }
    auto result_bits = run_kernel(*kernel, input);
    return {float_of(result_bits.out[0][0]), float_of(result_bits.out[1][0]),
            float_of(result_bits.out[2][0])};
}

TEST(Derivatives, WithSlopeIsTheFirstValueWithTheSecondsDerivatives) {
    auto got = derive(
        [](Builder& b, Value x, Value y) {
            Value r = b.op(Op::WithSlope, b.mul(x, x), b.mul(y, b.f(3)));
            return b.mul(r, x);  // x^3, whose slope is 3 y' x + x^2 x'
        },
        2, 5);
    EXPECT_EQ(got.value, 8);
    EXPECT_EQ(got.du, 3 * kYu * 2 + 4);
    EXPECT_EQ(got.dv, 3 * kYv * 2);
}

TEST(Derivatives, WithSlopeLeavesNothingWhereNoDerivativeIsAsked) {
    Module module;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    b.output({"value", Type::F}, b.op(Op::WithSlope, input_x(b), input_y(b)));
    b.finish();
    Module frame;
    optimize(module, &frame);
    ASSERT_EQ(module.inputs.size(), 1u) << print(module);
    EXPECT_EQ(module.inputs[0].name, "x");
}

// One function, as IR and in double.
struct Row {
    const char* name;
    std::function<Value(Builder&, Value, Value)> ir;
    std::function<double(double, double)> reference;
};

const Row kRows[] = {
    {"add", [](Builder& b, Value x, Value y) { return b.add(x, y); },
     [](double x, double y) { return x + y; }},
    {"sub", [](Builder& b, Value x, Value y) { return b.sub(x, y); },
     [](double x, double y) { return x - y; }},
    {"mul", [](Builder& b, Value x, Value y) { return b.mul(x, y); },
     [](double x, double y) { return x * y; }},
    {"div", [](Builder& b, Value x, Value y) { return b.div(x, y); },
     [](double x, double y) { return x / y; }},
    {"fma", [](Builder& b, Value x, Value y) { return b.fma(x, y, x); },
     [](double x, double y) { return x * y + x; }},
    {"min", [](Builder& b, Value x, Value y) { return b.min(x, y); },
     [](double x, double y) { return std::min(x, y); }},
    {"max", [](Builder& b, Value x, Value y) { return b.max(b.mul(x, x), y); },
     [](double x, double y) { return std::max(x * x, y); }},
    {"abs", [](Builder& b, Value x, Value y) { return b.abs(b.sub(x, y)); },
     [](double x, double y) { return std::abs(x - y); }},
    {"sqrt", [](Builder& b, Value x, Value y) { return b.sqrt(b.fma(x, x, b.mul(y, y))); },
     [](double x, double y) { return std::sqrt(x * x + y * y); }},
    {"floor", [](Builder& b, Value x, Value) { return b.sub(x, b.floor(x)); },
     [](double x, double) { return x - std::floor(x); }},
    {"sin", [](Builder& b, Value x, Value y) { return math::sin(b, b.mul(x, y), kPrecise); },
     [](double x, double y) { return std::sin(x * y); }},
    {"cos", [](Builder& b, Value x, Value y) { return math::cos(b, b.mul(x, y), kPrecise); },
     [](double x, double y) { return std::cos(x * y); }},
    {"tan", [](Builder& b, Value x, Value) { return math::tan(b, x, kPrecise); },
     [](double x, double) { return std::tan(x); }},
    {"asin", [](Builder& b, Value x, Value) { return math::asin(b, x, kPrecise); },
     [](double x, double) { return std::asin(x); }},
    {"acos", [](Builder& b, Value x, Value) { return math::acos(b, x, kPrecise); },
     [](double x, double) { return std::acos(x); }},
    {"atan", [](Builder& b, Value x, Value) { return math::atan(b, x, kPrecise); },
     [](double x, double) { return std::atan(x); }},
    {"atan2", [](Builder& b, Value x, Value y) { return math::atan2(b, y, x, kPrecise); },
     [](double x, double y) { return std::atan2(y, x); }},
    {"exp", [](Builder& b, Value x, Value y) { return math::exp(b, b.add(x, y), kPrecise); },
     [](double x, double y) { return std::exp(x + y); }},
    {"exp2", [](Builder& b, Value x, Value) { return math::exp2(b, x, kPrecise); },
     [](double x, double) { return std::exp2(x); }},
    {"log", [](Builder& b, Value x, Value) { return math::log(b, x, kPrecise); },
     [](double x, double) { return std::log(x); }},
    {"log2", [](Builder& b, Value x, Value) { return math::log2(b, x, kPrecise); },
     [](double x, double) { return std::log2(x); }},
    {"pow", [](Builder& b, Value x, Value y) { return math::pow(b, x, y, kPrecise); },
     [](double x, double y) { return std::pow(x, y); }},
    {"inversesqrt", [](Builder& b, Value x, Value) { return math::inversesqrt(b, x, kPrecise); },
     [](double x, double) { return 1 / std::sqrt(x); }},
};

TEST(Differentiate, RulesAgreeWithCentralDifferences) {
    constexpr double h = 1e-6;
    const float points[][2] = {{0.3f, 0.7f}, {0.55f, 1.9f}, {0.9f, 0.2f}};
    for (const Row& row : kRows) {
        for (auto [x, y] : points) {
            SCOPED_TRACE(row.name);
            auto at = [&](double du, double dv) {
                return row.reference(x + du, y + kYu * du + kYv * dv);
            };
            double du = (at(h, 0) - at(-h, 0)) / (2 * h), dv = (at(0, h) - at(0, -h)) / (2 * h);
            Derivatives got = derive(row.ir, x, y);
            EXPECT_NEAR(got.value, row.reference(x, y), 1e-5);
            EXPECT_NEAR(got.du, du, 2e-5 * (1 + std::abs(du)));
            EXPECT_NEAR(got.dv, dv, 2e-5 * (1 + std::abs(dv)));
        }
    }
}

TEST(Differentiate, TakesTheTakenSideOfABranch) {
    auto body = [](Builder& b, Value x, Value y) {
        Value m = b.lt(x, b.f(0.5f));
        b.begin_if(m);
        Value inner = b.mul(x, x);
        b.end_if();
        return b.merge(inner, y);
    };
    EXPECT_FLOAT_EQ(derive(body, 0.25f, 1).du, 0.5f);
    EXPECT_FLOAT_EQ(derive(body, 0.25f, 1).dv, 0.0f);
    EXPECT_FLOAT_EQ(derive(body, 0.75f, 1).dv, -2.0f);
}

// x^4 by three rounds of p = p * x.
TEST(Differentiate, FollowsLoopsAndArrays) {
    auto body = [](Builder& b, Value x, Value) {
        int array = b.declare_array("p", Type::F, 2);
        b.op(Op::ArrayStore, b.i(1), x, b.m(true), array);
        Value start = b.op(Op::ArrayLoad, b.i(1), kNone, kNone, array);
        int site = b.fault_site({}, "loop");
        Value m = b.begin_loop(b.m(true), site);
        Value i = b.loop_var(b.i(0));
        Value p = b.loop_var(start);
        Value next = b.iadd(i, b.i(1));
        Value more = b.logical_and(m, b.op(Op::ILt, next, b.i(3)));
        b.end_loop(more, std::vector<Value>{next, b.mul(p, x)});
        return b.loop_out(p);
    };
    Derivatives got = derive(body, 1.5f, 0);
    EXPECT_FLOAT_EQ(got.value, 5.0625f);
    EXPECT_FLOAT_EQ(got.du, 4 * 3.375f);
    EXPECT_FLOAT_EQ(got.dv, 0.0f);
}

TEST(Differentiate, NoiseHasTheSlopeOfItsValues) {
    auto body = [](Builder& b, Value x, Value y) {
        return math::noise(b, b.m(true), std::vector<Value>{x, y}, 1)[0];
    };
    constexpr float h = 1e-3f;
    for (float x : {0.3f, 1.7f, 5.45f}) {
        float y = 0.4f + x;
        auto yu = static_cast<float>(kYu), yv = static_cast<float>(kYv);
        float du = (derive(body, x + h, y + yu * h).value - derive(body, x - h, y - yu * h).value) /
                   (2 * h);
        float dv =
            (derive(body, x, y + yv * h).value - derive(body, x, y - yv * h).value) / (2 * h);
        Derivatives got = derive(body, x, y);
        EXPECT_NEAR(got.du, du, 2e-3f);
        EXPECT_NEAR(got.dv, dv, 4e-3f);
        EXPECT_NE(got.du, 0);
    }
}

TEST(Differentiate, TheDerivativeOfADerivativeIsZero) {
    auto body = [](Builder& b, Value x, Value) { return b.op(Op::Du, b.mul(x, x)); };
    Derivatives got = derive(body, 3.0f, 0);
    EXPECT_EQ(got.value, 6.0f);
    EXPECT_EQ(got.du, 0.0f);
}

}  // namespace
}  // namespace kinora::jit
