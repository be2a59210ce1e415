// tests/jit/pass_test.cpp: what each pass achieves on small modules (that it keeps the meaning is
// fuzz_test.cpp's claim).
#include <gtest/gtest.h>

#include "jit/codegen/code_memory.h"
#include "jit/compiler.h"
#include "jit/ir/analysis.h"
#include "jit/ir/builder.h"
#include "jit/passes/passes.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

Module read(const std::string& body, const char* results = "(f)") {
    std::string text =
        "module \"m\" budget 100 slots 0\ninput \"x\" f point\ninput \"k\" f frame\n"
        "input \"a\" f frame\ninput \"b\" f frame\noutput \"y\" f\n"
        "service \"noise\" (f) -> (f) pure\nfault \"loop\"\nfunction \"kernel\" () -> ";
    text += results + ("\n" + body);
    Diagnostics diagnostics;
    Module module = parse_module(text, "m.ir", diagnostics);
    for (const Finding& finding : diagnostics.findings())
        ADD_FAILURE() << format_finding(finding, diagnostics.files);
    return module;
}

int count(const Module& module, Op op) {
    int n = 0;
    for (const Function& function : module.functions)
        for (const Inst& inst : function.insts) n += inst.op == op;
    return n;
}

TEST(Fold, OpensAnIfThatAlwaysRunsAndDropsOneThatNever) {
    Module module = read(
        "%0 = input.f\n%1 = constm #1\n%2 = constm\nif %1\n%4 = mul %0, %0\nendif #3\n"
        "%6 = merge.f %4, %0, #3\nif %2\n%8 = neg %6\nendif #7\n%10 = merge.f %8, %6, #7\n"
        "return [%10]\nend\n");
    fold(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(count(module, Op::If), 0);
    EXPECT_EQ(count(module, Op::Neg), 0);
    EXPECT_EQ(module.kernel().insts.back().op, Op::Return);
}

TEST(Fold, KeepsInexactIdentities) {
    Module module = read(
        "%0 = input.f\n%1 = constf 0\n%2 = mul %0, %1\n%3 = add %2, %1\n%4 = fma %0, %0, %1\n"
        "%5 = add %3, %4\nreturn [%5]\nend\n");
    fold(module);
    EXPECT_EQ(count(module, Op::Mul), 1);
    EXPECT_EQ(count(module, Op::Add), 2);
    EXPECT_EQ(count(module, Op::Fma), 1);
}

TEST(Fold, ReplacesLoopVariablesThatNeverChange) {
    Module module = read(
        "%0 = input.f\n%1 = constm #1\n%2 = loop %1\n%3 = loopvar.f %0, #2\n"
        "%4 = loopvar.f %0, #2\n%5 = add %3, %4\n%6 = lt %5, %0\nendloop %6, #2, [%3 %5]\n"
        "%8 = loopout.f %4\nreturn [%8]\nend\n");
    fold(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(count(module, Op::LoopVar), 1);
}

TEST(Cse, MergesEqualValuesAndHoistsInvariantsOutOfLoops) {
    Module module = read(
        "%0 = input.f\n%1 = constm #1\n%2 = mul %0, %0\n%3 = mul %0, %0\n%4 = loop %1\n"
        "%5 = loopvar.f %2, #4\n%6 = sqrt %3\n%7 = add %5, %6\n%8 = lt %7, %0\n"
        "endloop %8, #4, [%7]\n%10 = loopout.f %5\nreturn [%10]\nend\n");
    cse(module);
    EXPECT_EQ(verify(module), "") << print(module);
    EXPECT_EQ(count(module, Op::Mul), 1);
    Value loop = 0, root = 0;
    for (Value v = 0; v < module.kernel().insts.size(); ++v) {
        if (module.kernel().insts[v].op == Op::Loop) loop = v;
        if (module.kernel().insts[v].op == Op::Sqrt) root = v;
    }
    EXPECT_LT(root, loop);
}

TEST(Cse, ReadsAgainAfterAStore) {
    Module module = read(
        "array \"t\" f 2\n%0 = input.f\n%1 = consti\n%2 = constm #1\n%3 = arrayload.f %1\n"
        "arraystore %1, %0, %2\n%5 = arrayload.f %1\n%6 = arrayload.f %1\n%7 = add %3, %5\n"
        "%8 = add %7, %6\nreturn [%8]\nend\n");
    cse(module);
    EXPECT_EQ(count(module, Op::ArrayLoad), 2);
}

TEST(Cse, MergesPureCallsOfEqualArguments) {
    Module module = read(
        "%0 = input.f\n%1 = constm #1\n%2 = input.f\nservice %1, [%0]\n%4 = result.f %3\n"
        "service %1, [%2]\n%6 = result.f %5\n%7 = add %4, %6\nreturn [%7]\nend\n");
    cse(module);
    EXPECT_EQ(verify(module), "") << print(module);
    EXPECT_EQ(count(module, Op::Service), 1);
}

TEST(Dce, DropsWhatNothingNeedsCyclesIncluded) {
    Module module = read(
        "array \"t\" f 2\n%0 = input.f\n%1 = input.f #1\n%2 = constm #1\n%3 = consti\n"
        "arraystore %3, %0, %2\n%5 = loop %2\n%6 = loopvar.f %1, #5\n%7 = add %6, %6\n"
        "%8 = lt %7, %0\nendloop %8, #5, [%7]\nservice %2, [%1]\n%11 = result.f %10\n"
        "return [%0]\nend\n");
    dce(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(module.kernel().insts.size(), 2u) << print(module);
    EXPECT_EQ(module.inputs.size(), 1u);
    EXPECT_TRUE(module.services.empty());
    EXPECT_TRUE(module.kernel().arrays.empty());
}

TEST(InlineCalls, OpensSmallFunctionsAndKeepsLargeSharedOnes) {
    Module module;
    add_function(module, "kernel", {});
    size_t small = add_function(module, "small", {Type::F});
    size_t large = add_function(module, "large", {Type::F});
    for (auto [index, steps] : {std::pair{small, 3}, std::pair{large, 60}}) {
        Builder f(module, index);
        Value x = f.param(Type::F), y = x;
        for (int k = 0; k < steps; ++k) y = f.fma(y, x, x);
        f.ret(std::vector<Value>{y});
    }
    Builder b(module, 0);
    Value x = b.input({"x", Type::F, Rate::Point, "", ""}), m = b.m(true);
    for (size_t index : {small, small, large, large})
        x = b.call(index, m, std::vector<Value>{x})[0];
    b.output({"y", Type::F}, x);
    b.finish();
    inline_calls(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(count(module, Op::Call), 2);
}

TEST(Hoist, LeavesOnlyTheFrontierOfFrameWorkInThePointKernel) {
    Module module = read(
        "%0 = input.f\n%1 = input.f #1\n%2 = sqrt %1\n%3 = mul %2, %1\n%4 = mul %3, %0\n"
        "return [%4]\nend\n");
    Module frame = hoist(module);
    dce(frame);
    dce(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(verify(frame), "");
    EXPECT_EQ(module.frame_slots, 1);
    EXPECT_EQ(frame.outputs.size(), 1u);
    EXPECT_EQ(frame.outputs[0].name, "frame:0");
    EXPECT_EQ(count(module, Op::Sqrt), 0);
    ASSERT_EQ(module.inputs.size(), 1u);
    EXPECT_EQ(module.inputs[0].name, "x");
    ASSERT_EQ(frame.inputs.size(), 1u);
    EXPECT_EQ(frame.inputs[0].name, "k");
}

TEST(Hoist, TakesFrameWorkOutOfABranchOfPoints) {
    Module module = read(
        "%0 = input.f\n%1 = input.f #1\n%2 = lt %0, %1\nif %2\n%4 = sqrt %1\n%5 = mul %0, %4\n"
        "endif #3\n%7 = merge.f %5, %0, #3\nreturn [%7]\nend\n");
    Module frame = hoist(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(verify(frame), "");
    EXPECT_EQ(count(module, Op::Sqrt), 0);
    EXPECT_EQ(module.frame_slots, 2);  // k itself and its root
}

TEST(Hoist, MovesWholeLoopsAndPureServices) {
    Module module = read(
        "%0 = input.f\n%1 = input.f #1\n%2 = constm #1\n%3 = constf 100\n%4 = loop %2\n"
        "%5 = loopvar.f %1, #4\n%6 = add %5, %5\n%7 = lt %6, %3\nendloop %7, #4, [%6]\n"
        "%9 = loopout.f %5\n%10 = lt %0, %9\nservice %10, [%9]\n%12 = result.f %11\n"
        "%13 = select.f %10, %12, %0\nreturn [%13]\nend\n");
    Module frame = hoist(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(verify(frame), "") << print(frame);
    EXPECT_EQ(count(module, Op::Loop), 0);
    EXPECT_EQ(count(module, Op::Service), 0);
    EXPECT_EQ(count(frame, Op::Loop), 1);
    EXPECT_EQ(count(frame, Op::Service), 1);
}

TEST(Hoist, GathersFrameArraysFromNeighbouringSlots) {
    Module module =
        read("%0 = input.f\n%1 = ftoi %0\n%2 = inputgather.f %1, #1, #3\nreturn [%2]\nend\n");
    Module frame = hoist(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(module.frame_slots, 3);
    EXPECT_EQ(count(module, Op::FrameGather), 1);
    EXPECT_EQ(count(module, Op::InputGather), 0);
    EXPECT_EQ(frame.outputs.size(), 3u);
}

TEST(LanesAgree, FollowsMasksOfLoops) {
    Module module = read(
        "%0 = input.f\n%1 = constm #1\n%2 = consti\n%3 = consti #1\n%4 = lt %0, %0\n"
        "%5 = loop %1\n%6 = loopvar.i %2, #5\n%7 = iadd %6, %3\n%8 = ilt %7, %3\n"
        "endloop %8, #5, [%7]\n%10 = loopout.i %6\n%11 = loop %4\n%12 = loopvar.i %2, #11\n"
        "endloop %11, #11, [%3]\n%14 = loopout.i %12\nreturn [%0]\nend\n");
    std::vector<bool> agree = lanes_agree(module, module.kernel());
    EXPECT_TRUE(agree[10]);
    EXPECT_FALSE(agree[14]);
    EXPECT_FALSE(agree[0]);
}

TEST(Compile, SharesKernelsWithEqualIr) {
    clear_cache();
    const char* body = "%0 = input.f\n%1 = input.f #1\n%2 = mul %0, %1\nreturn [%2]\nend\n";
    KernelPair first = compile(read(body)), second = compile(read(body));
    EXPECT_FALSE(first.cached);
    EXPECT_TRUE(second.cached);
    EXPECT_EQ(first.point, second.point);
    EXPECT_EQ(first.frame, second.frame);
    EXPECT_EQ(first.point->frame_slots, 1);
    EXPECT_NE(first.point->ir_hash, 0u);
    EXPECT_EQ(cache_stats().kernels, 2u);
    first = second = {};
    clear_cache();
    EXPECT_EQ(cache_stats().kernels, 0u);
}

TEST(Compile, FallsBackToTheInterpreterWithoutExecutableMemory) {
    clear_cache();
    deny_executable_memory(true);
    KernelPair pair = compile(read("%0 = input.f\n%1 = neg %0\nreturn [%1]\nend\n"));
    deny_executable_memory(false);
    EXPECT_STREQ(pair.point->target, "interp");
    EXPECT_EQ(pair.frame, nullptr);
    test::RunInput input;
    input.inputs = {{bits_of(2.0f)}};
    EXPECT_EQ(float_of(test::run_kernel(*pair.point, input).out[0][0]), -2.0f);
    pair = {};
    clear_cache();
}

TEST(Compile, DumpsEveryStage) {
    std::vector<std::pair<std::string, std::string>> dumps;
    CompileOptions options;
    options.dumps = &dumps;
    compile(read("%0 = input.f\n%1 = neg %0\nreturn [%1]\nend\n"), options);
    std::vector<std::string> names;
    for (const auto& [name, text] : dumps) names.push_back(name);
    EXPECT_EQ(names.front(), "ir");
    for (const char* wanted : {"ir:fold", "ir:cse", "ir:hoist", "asm"})
        EXPECT_NE(std::find(names.begin(), names.end(), wanted), names.end()) << wanted;
}

}  // namespace
}  // namespace kinora::jit
