// tests/jit/fuzz_test.cpp: random programs mean the same before and after each pass and on every
// target. KINORA_FUZZ=N sets the number of programs, KINORA_FUZZ_SEED the first seed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "jit/compiler.h"
#include "tests/jit/random_module.h"
#include "tests/jit/reduce.h"
#include "tests/jit/world.h"

namespace kinora::jit::test {
namespace {

constexpr uint64_t kDefaultPrograms = 2000;

uint64_t environment(const char* name, uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct Program {
    Module module;
    uint64_t seed;
};

Program program(uint64_t seed) {
    const RandomPolicy& policy = kPolicies[seed % static_cast<uint64_t>(kPolicyCount)];
    int size = 20 << (seed / static_cast<uint64_t>(kPolicyCount) % 4);
    return {random_module(seed, policy, size), seed};
}

World world_of(uint64_t seed) {
    return World(seed * 7919 + 1, 1 + static_cast<int32_t>(seed % 37));
}

std::shared_ptr<Kernel> interp(const Module& module) {
    return find_target("interp")->emit(module, nullptr);
}

// A check says "" or what is wrong with a module.
using Check = std::function<std::string(const Module&, uint64_t seed)>;

// Runs a check over many programs; the first failure is reduced and printed.
void fuzz(const Check& check, uint64_t programs) {
    uint64_t first = environment("KINORA_FUZZ_SEED", 1);
    for (uint64_t seed = first; seed < first + programs; ++seed) {
        Program p = program(seed);
        ASSERT_EQ(verify(p.module), "") << "seed " << seed << "\n" << print(p.module);
        std::string wrong = check(p.module, seed);
        if (wrong.empty()) continue;
        Module small = reduce(p.module, [&](const Module& m) { return !check(m, seed).empty(); });
        FAIL() << "seed " << seed << ": " << wrong << "\nreduced: " << check(small, seed) << "\n"
               << print(small);
    }
}

uint64_t programs() {
    return environment("KINORA_FUZZ", kDefaultPrograms);
}

struct PassRow {
    const char* name;
    void (*run)(Module&);
};
const PassRow kPasses[] = {
    {"inline_calls", inline_calls},
    {"fold", fold},
    {"cse", cse},
    {"dce", dce},
};

// A loop that nobody needs may go, and its budget's fault (site 0) with it.
void forgive_loop_fault(RunResult& before, const RunResult& after) {
    if (before.fault[0] == 1 && after.fault[0] == 0) before.fault[0] = 0;
}

std::string same_after(const Module& module, uint64_t seed, void (*pass)(Module&)) {
    Module changed = module;
    pass(changed);
    if (std::string error = verify(changed); !error.empty()) return error + "\n" + print(changed);
    World world = world_of(seed);
    auto kernel = interp(module);
    RunResult before = world.run(*kernel);
    RunResult after = world.run(*interp(changed));
    forgive_loop_fault(before, after);
    return difference(*kernel, before, after);
}

std::string same_after_hoist(const Module& module, uint64_t seed) {
    Module point = module;
    Module frame = hoist(point);
    for (const Module* m : {&point, &frame})
        if (std::string error = verify(*m); !error.empty()) return error + "\n" + print(*m);
    World world = world_of(seed);
    auto kernel = interp(module);
    RunResult before = world.run(*kernel);
    RunResult after = world.run_pair(interp(frame).get(), *interp(point));
    forgive_loop_fault(before, after);
    return difference(*kernel, before, after);
}

// Derivatives must not change what was there, and the module that has them must survive the rest.
std::string same_with_derivatives(const Module& module, uint64_t seed) {
    Module plain = with_derivatives(module, seed);
    differentiate(plain);
    if (std::string error = verify(plain); !error.empty()) return error + "\n" + print(plain);
    Module point = plain, frame;
    optimize(point, &frame);
    for (const Module* m : {&point, &frame})
        if (std::string error = verify(*m); !error.empty()) return error + "\n" + print(*m);
    World world = world_of(seed);
    auto kernel = interp(module);
    RunResult before = world.run(*kernel);
    RunResult after = world.run(*interp(plain));
    RunResult last = world.run_pair(interp(frame).get(), *interp(point));
    forgive_loop_fault(after, last);
    std::string wrong = difference(*interp(plain), after, last);
    if (!wrong.empty()) return "after optimize: " + wrong;
    forgive_loop_fault(before, after);
    return difference(*kernel, before, after);
}

std::string same_after_optimize(const Module& module, uint64_t seed) {
    Module point = module, frame;
    optimize(point, &frame);
    for (const Module* m : {&point, &frame})
        if (std::string error = verify(*m); !error.empty()) return error + "\n" + print(*m);
    for (const InputInfo& input : point.inputs)
        if (input.rate != Rate::Point) return "a frame input is left: " + input.name;
    World world = world_of(seed);
    auto kernel = interp(module);
    RunResult before = world.run(*kernel);
    RunResult after = world.run_pair(interp(frame).get(), *interp(point));
    forgive_loop_fault(before, after);
    return difference(*kernel, before, after);
}

TEST(Fuzz, EachPassKeepsTheMeaning) {
    for (const PassRow& pass : kPasses) {
        SCOPED_TRACE(pass.name);
        fuzz([&](const Module& m, uint64_t seed) { return same_after(m, seed, pass.run); },
             programs());
        if (HasFatalFailure()) return;
    }
}

TEST(Fuzz, HoistKeepsTheMeaning) {
    fuzz(same_after_hoist, programs());
}

TEST(Fuzz, DerivativesKeepTheMeaning) {
    fuzz(same_with_derivatives, programs());
}

TEST(Fuzz, AllPassesTogetherKeepTheMeaning) {
    fuzz(same_after_optimize, programs());
}

class TargetFuzz : public testing::TestWithParam<const Target*> {};

TEST_P(TargetFuzz, EqualsTheInterpreterBitForBit) {
    const Target& target = *GetParam();
    if (!target.supported()) GTEST_SKIP() << "this CPU lacks " << target.name;
    fuzz(
        [&](const Module& module, uint64_t seed) -> std::string {
            World world = world_of(seed);
            auto kernel = target.emit(module, nullptr);
            if (kernel == nullptr) return "no executable memory";
            RunResult wanted = world.run(*interp(module));
            return difference(*kernel, wanted, world.run(*kernel));
        },
        programs());
}

TEST_P(TargetFuzz, EqualsTheInterpreterAfterOptimize) {
    const Target& target = *GetParam();
    if (!target.supported()) GTEST_SKIP() << "this CPU lacks " << target.name;
    fuzz(
        [&](const Module& module, uint64_t seed) -> std::string {
            Module point = module, frame;
            optimize(point, &frame);
            World world = world_of(seed);
            auto frame_kernel = target.emit(frame, nullptr);
            auto kernel = target.emit(point, nullptr);
            if (kernel == nullptr || frame_kernel == nullptr) return "no executable memory";
            RunResult wanted = world.run_pair(interp(frame).get(), *interp(point));
            return difference(*kernel, wanted, world.run_pair(frame_kernel.get(), *kernel));
        },
        programs());
}

std::vector<const Target*> compiled_targets() {
    std::vector<const Target*> list;
    for (const Target& target : targets())
        if (std::string_view(target.name) != "interp") list.push_back(&target);
    return list;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(TargetFuzz);
INSTANTIATE_TEST_SUITE_P(Targets, TargetFuzz, testing::ValuesIn(compiled_targets()),
                         [](const auto& row) { return std::string(row.param->name); });

}  // namespace
}  // namespace kinora::jit::test
