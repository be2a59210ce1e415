// tests/jit/unwind_test.cpp: exceptions of services leave kernels as they leave C++ functions.
#include <gtest/gtest.h>

#include <new>

#include "jit/ir/builder.h"
#include "jit/target.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

using test::RunInput;

// Thrown where the service is asked for the point.
struct Thrown {
    int32_t first;
};

void throws_at_20(const ServiceCall& call) {
    if (call.first + call.lanes > 20) throw Thrown{call.first};
    for (int i = 0; i < call.lanes; ++i) call.results[i] = call.args[i];
}

void out_of_memory(const ServiceCall&) {
    throw std::bad_alloc();
}

// Runs the kernel that grid points at, as shaders of hit surfaces run.
void runs_another(const ServiceCall& call) {
    RunInput in;
    in.count = 3;
    in.inputs = {{0, 1, 2}};
    in.services = {out_of_memory};
    run_kernel(*static_cast<const Kernel*>(call.grid), in);
}

// y = the service's answer for x, asked in `depth` functions that call each other.
Module asks(size_t depth) {
    Module m;
    m.name = "asks";
    add_function(m, "kernel", {});
    for (size_t k = 0; k < depth; ++k) add_function(m, "f" + std::to_string(k), {Type::F});
    auto body = [&](Builder& b, size_t k, Value x) {
        if (k < depth) return b.call(k + 1, b.m(true), std::vector{x})[0];
        int slot = b.declare_service({"ask", {Type::F}, {Type::F}});
        return b.service(slot, b.m(true), std::vector{x})[0];
    };
    for (size_t k = depth; k-- > 0;) {
        Builder b(m, k + 1);
        Value x = b.param(Type::F);
        Value y = body(b, k + 1, x);
        b.ret(std::vector{b.add(x, y)});
    }
    Builder b(m, 0);
    Value x = b.input({"x", Type::F, Rate::Point, "", ""});
    b.output({"y", Type::F}, b.add(x, body(b, 0, x)));
    b.finish();
    EXPECT_EQ(verify(m), "");
    return m;
}

RunInput thirty(ServiceFn service) {
    RunInput in;
    in.count = 30;
    in.inputs.resize(1);
    for (int k = 0; k < in.count; ++k) in.inputs[0].push_back(bits_of(float(k)));
    in.services = {service};
    return in;
}

std::vector<const Target*> all_targets() {
    std::vector<const Target*> list;
    for (const Target& target : targets())
        if (target.supported()) list.push_back(&target);
    return list;
}

TEST(Unwind, AnExceptionOfAServiceLeavesTheKernel) {
    for (const Target* target : all_targets())
        for (size_t depth : {0u, 1u, 3u}) {
            SCOPED_TRACE(target->name + (" " + std::to_string(depth)));
            std::shared_ptr<Kernel> kernel = target->emit(asks(depth), nullptr);
            ASSERT_NE(kernel, nullptr);
            EXPECT_THROW(run_kernel(*kernel, thirty(out_of_memory)), std::bad_alloc);
            int32_t first = -1;
            try {
                run_kernel(*kernel, thirty(throws_at_20));
            } catch (const Thrown& thrown) {
                first = thrown.first;
            }
            EXPECT_EQ(first, 20 / target->lanes * target->lanes);  // the group of point 20
        }
}

TEST(Unwind, PassesThroughAKernelThatAServiceRuns) {
    for (const Target* target : all_targets()) {
        SCOPED_TRACE(target->name);
        std::shared_ptr<Kernel> outer = target->emit(asks(1), nullptr);
        std::shared_ptr<Kernel> inner = target->emit(asks(2), nullptr);
        RunInput in = thirty(runs_another);
        in.grid = inner.get();
        EXPECT_THROW(run_kernel(*outer, in), std::bad_alloc);
    }
}

// More values than a machine has registers that a callee keeps.
[[gnu::noinline]] double sum_of_kept(const Kernel& kernel, const RunInput& in, int n, double x) {
    int a[8];
    double d[10];
    for (int k = 0; k < 8; ++k) a[k] = n * (k + 3);
    for (int k = 0; k < 10; ++k) d[k] = x * (k + 3);
    bool thrown = false;
    try {
        run_kernel(kernel, in);
    } catch (const std::bad_alloc&) {
        thrown = true;
    }
    double sum = 0;
    for (int value : a) sum = sum * 3 + value;
    for (double value : d) sum = sum * 3 + value;
    return thrown ? sum : -1;
}

TEST(Unwind, RestoresTheRegistersOfTheCaller) {
    double expected = 0;
    for (int k = 0; k < 8; ++k) expected = expected * 3 + 5 * (k + 3);
    for (int k = 0; k < 10; ++k) expected = expected * 3 + 7 * (k + 3);
    for (const Target* target : all_targets()) {
        SCOPED_TRACE(target->name);
        std::shared_ptr<Kernel> kernel = target->emit(asks(2), nullptr);
        EXPECT_EQ(sum_of_kept(*kernel, thirty(out_of_memory), 5, 7), expected);
    }
}

// The runtime's list of code must forget what is gone.
TEST(Unwind, HoldsWhenKernelsComeAndGo) {
    for (const Target* target : all_targets()) {
        std::vector<std::shared_ptr<Kernel>> kernels;
        for (int round = 0; round < 60; ++round) {
            kernels.push_back(target->emit(asks(static_cast<size_t>(round % 3)), nullptr));
            if (round % 2 == 1) kernels.erase(kernels.begin() + round / 4);
            EXPECT_THROW(run_kernel(*kernels.back(), thirty(out_of_memory)), std::bad_alloc);
        }
    }
}

}  // namespace
}  // namespace kinora::jit
