// tests/jit/builder_test.cpp: what Builder writes verifies and means what was asked.
#include "jit/ir/builder.h"
#include "jit/target.h"

#include <gtest/gtest.h>

#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::run_kernel;
using test::RunInput;

Module empty_module() {
    Module module;
    module.name = "test";
    add_function(module, "kernel", {});
    return module;
}

InputInfo point_input(const char* name, Type type = Type::F) {
    return {name, type, Rate::Point, "", ""};
}

std::shared_ptr<Kernel> interp(const Module& module) {
    EXPECT_EQ(verify(module), "") << print(module);
    return find_target("interp")->emit(module, nullptr);
}

TEST(Builder, FoldsWhatIsExactAndKeepsWhatIsNot) {
    Module module = empty_module();
    Builder b(module, 0);
    Value x = b.input(point_input("x"));
    EXPECT_EQ(b.mul(x, b.f(1)), x);
    EXPECT_EQ(b.add(x, b.f(-0.0f)), x);
    EXPECT_EQ(b.sub(x, b.f(0)), x);
    EXPECT_NE(b.add(x, b.f(0)), x);
    EXPECT_EQ(b.inst(b.mul(x, b.f(0))).op, Op::Mul);
    Value less = b.lt(x, b.f(2));
    EXPECT_EQ(b.logical_not(b.logical_not(less)), less);
    float value = 0;
    EXPECT_TRUE(b.constant_f(b.add(b.f(1), b.f(2)), &value));
    EXPECT_EQ(value, 3.0f);
    EXPECT_EQ(b.f(3), b.add(b.f(1), b.f(2)));
}

// Sum of i*x for i below n, n an int input: 0 for n <= 0.
TEST(Interp, RunsALoopPerLane) {
    Module module = empty_module();
    Builder b(module, 0);
    Value x = b.input(point_input("x"));
    Value n = b.input(point_input("n", Type::I));
    int site = b.fault_site({}, "budget");
    Value m = b.begin_loop(b.op(Op::ILt, b.i(0), n), site);
    Value i = b.loop_var(b.i(0));
    Value sum = b.loop_var(b.f(0));
    Value next_sum = b.fma(b.itof(i), x, sum);
    Value next_i = b.iadd(i, b.i(1));
    b.end_loop(b.logical_and(m, b.op(Op::ILt, next_i, n)), std::vector<Value>{next_i, next_sum});
    b.output({"sum", Type::F}, b.loop_out(sum));
    b.finish();
    auto kernel = interp(module);
    RunInput input;
    input.count = 37;
    input.inputs.resize(2);
    for (int p = 0; p < input.count; ++p) {
        input.inputs[0].push_back(bits_of(0.5f * static_cast<float>(p)));
        input.inputs[1].push_back(p % 7 - 1);
    }
    auto result = run_kernel(*kernel, input);
    for (int p = 0; p < input.count; ++p) {
        int count = std::max(p % 7 - 1, 0);
        EXPECT_EQ(float_of(result.out[0][static_cast<size_t>(p)]),
                  0.5f * static_cast<float>(p * (count * (count - 1) / 2)));
    }
}

TEST(Interp, EndsALoopAtItsBudgetWithAFault) {
    Module module = empty_module();
    module.loop_budget = 10;
    Builder b(module, 0);
    int site = b.fault_site({}, "budget");
    b.begin_loop(b.m(true), site);
    Value i = b.loop_var(b.i(0));
    b.end_loop(b.m(true), std::vector<Value>{b.iadd(i, b.i(1))});
    b.output({"i", Type::I}, b.loop_out(i));
    b.finish();
    RunInput input;
    auto result = run_kernel(*interp(module), input);
    EXPECT_EQ(result.out[0][0], 10);
    EXPECT_EQ(result.fault[0], 1);
}

TEST(Interp, MergesAndCallsPerLane) {
    Module module = empty_module();
    size_t square = add_function(module, "square", {Type::F});
    {
        Builder f(module, square);
        Value x = f.param(Type::F);
        f.ret(std::vector<Value>{f.mul(x, x)});
    }
    Builder b(module, 0);
    Value x = b.input(point_input("x"));
    Value m = b.lt(x, b.f(3));
    b.begin_if(m);
    Value y = b.call(square, m, std::vector<Value>{x})[0];
    b.end_if();
    b.output({"y", Type::F}, b.merge(y, b.f(-1)));
    b.finish();
    RunInput input;
    input.count = 6;
    input.inputs.resize(1);
    for (int p = 0; p < 6; ++p) input.inputs[0].push_back(bits_of(static_cast<float>(p)));
    auto result = run_kernel(*interp(module), input);
    const float expected[] = {0, 1, 4, -1, -1, -1};
    for (size_t p = 0; p < 6; ++p) EXPECT_EQ(float_of(result.out[0][p]), expected[p]);
}

}  // namespace
}  // namespace kinora::jit
