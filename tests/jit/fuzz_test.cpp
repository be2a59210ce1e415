// tests/jit/fuzz_test.cpp: random programs mean the same before and after each pass and on every
// target. KINORA_FUZZ=N sets the number of programs, KINORA_FUZZ_SEED the first seed; a tenth more
// run from a fresh seed, which is printed.
#include <gtest/gtest.h>

#include <functional>

#include "jit/compiler.h"
#include "jit/passes/passes.h"
#include "tests/folders.h"
#include "tests/fuzz_settings.h"
#include "tests/jit/module_difference.h"
#include "tests/jit/random_module.h"
#include "tests/jit/reduce.h"

namespace kinora::jit::test {
namespace {

constexpr uint64_t kDefaultPrograms = 2000;
const std::string kKept = project_folder() + "/tests/jit/kept";

struct Program {
    Module module;
    uint64_t seed;
};

Program program(uint64_t seed) {
    const RandomPolicy& policy = kPolicies[seed % static_cast<uint64_t>(kPolicyCount)];
    int size = 20 << (seed / static_cast<uint64_t>(kPolicyCount) % 4);
    return {random_module(seed, policy, size), seed};
}

std::shared_ptr<Kernel> interp(const Module& module) {
    return find_target("interp")->emit(module, nullptr);
}

// A check says "" or what is wrong with a module.
using Check = std::function<std::string(const Module&, uint64_t seed)>;

// Checks programs from `first` on; the first failure is reduced, written to a file and printed.
void fuzz_from(const Check& check, uint64_t first, uint64_t programs) {
    for (uint64_t seed = first; seed < first + programs; ++seed) {
        Program p = program(seed);
        ASSERT_EQ(verify(p.module), "") << "seed " << seed << "\n" << print(p.module);
        std::string wrong = check(p.module, seed);
        if (wrong.empty()) continue;
        Module small = reduce(p.module, [&](const Module& m) { return !check(m, seed).empty(); });
        std::string text = "; world " + std::to_string(seed) + "\n" + print(small);
        FAIL() << "seed " << seed << ": " << wrong << "\nreduced: " << check(small, seed) << "\nin "
               << keep_reduced(kKept, "seed" + std::to_string(seed) + ".ir", text) << "\n"
               << text;
    }
}

// From the fixed seed, and a tenth more from a seed nobody has run.
void fuzz(const Check& check, uint64_t programs) {
    fuzz_from(check, fuzz_setting("KINORA_FUZZ_SEED", 1), programs);
    if (testing::Test::HasFatalFailure()) return;
    std::printf("%llu programs, and %llu from fresh seed %llu (KINORA_FUZZ_FRESH)\n",
                static_cast<unsigned long long>(programs),
                static_cast<unsigned long long>((programs + 9) / 10),
                static_cast<unsigned long long>(fresh_seed()));
    fuzz_from(check, fresh_seed(), (programs + 9) / 10);
}

uint64_t programs() {
    return fuzz_setting("KINORA_FUZZ", kDefaultPrograms);
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
    {"schedule", schedule},
    {"unmask", unmask_uniform_loops},
};

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

std::string malformed(const Module& frame, const Module& point) {
    for (const Module* m : {&point, &frame})
        if (std::string error = verify(*m); !error.empty()) return error + "\n" + print(*m);
    return "";
}

// A frame kernel and a point kernel that came of one module.
std::string same_as_pair(const Module& module, uint64_t seed, const Module& frame,
                         const Module& point) {
    World world = world_of(seed);
    auto kernel = interp(module);
    RunResult before = world.run(*kernel);
    RunResult after = world.run_pair(interp(frame).get(), *interp(point));
    forgive_loop_fault(before, after);
    return difference(*kernel, before, after);
}

std::string same_after_hoist(const Module& module, uint64_t seed) {
    Module point = module;
    Module frame = hoist(point);
    if (std::string error = malformed(frame, point); !error.empty()) return error;
    return same_as_pair(module, seed, frame, point);
}

// Derivatives must not change what was there, and the module that has them must survive the rest.
std::string same_with_derivatives(const Module& module, uint64_t seed) {
    Module plain = with_derivatives(module, seed);
    differentiate(plain);
    if (std::string error = verify(plain); !error.empty()) return error + "\n" + print(plain);
    Module point = plain, frame;
    optimize(point, &frame);
    if (std::string error = malformed(frame, point); !error.empty()) return error;
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
    if (std::string error = malformed(frame, point); !error.empty()) return error;
    for (const InputInfo& input : point.inputs)
        if (input.rate != Rate::Point) return "a frame input is left: " + input.name;
    return same_as_pair(module, seed, frame, point);
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
        [&](const Module& module, uint64_t seed) {
            std::string wrong = target.check(module);
            return wrong.empty() ? target_difference(module, target, seed) : wrong;
        },
        programs());
}

TEST_P(TargetFuzz, EqualsTheInterpreterAfterOptimize) {
    const Target& target = *GetParam();
    if (!target.supported()) GTEST_SKIP() << "this CPU lacks " << target.name;
    fuzz([&](const Module& module,
             uint64_t seed) { return optimized_difference(module, target, seed); },
         programs());
}

std::vector<const Target*> compiled_targets() {
    std::vector<const Target*> list;
    for (const Target& target : targets())
        if (std::string_view(target.name) != "interp") list.push_back(&target);
    return list;
}

// "; world 12" on the first line of a kept file.
TEST(Fuzz, KeptProgramsAgree) {
    int files = 0;
    for (auto& entry : std::filesystem::directory_iterator(kKept)) {
        if (entry.path().extension() != ".ir") continue;
        std::ifstream file(entry.path());
        std::string text(std::istreambuf_iterator<char>(file), {});
        Diagnostics diagnostics;
        Module module = parse_module(text, entry.path().filename().string(), diagnostics);
        ASSERT_FALSE(diagnostics.has_errors()) << entry.path();
        size_t at = text.find("; world ");
        ASSERT_NE(at, std::string::npos) << entry.path();
        uint64_t seed = std::strtoull(text.c_str() + at + 8, nullptr, 10);
        EXPECT_EQ(module_difference(module, seed), "") << entry.path();
        EXPECT_EQ(same_after_optimize(module, seed), "") << entry.path();
        ++files;
    }
    EXPECT_GT(files, 0);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(TargetFuzz);
INSTANTIATE_TEST_SUITE_P(Targets, TargetFuzz, testing::ValuesIn(compiled_targets()),
                         [](const auto& row) { return std::string(row.param->name); });

}  // namespace
}  // namespace kinora::jit::test
