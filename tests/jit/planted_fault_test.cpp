// tests/jit/planted_fault_test.cpp: tests the tests: every planted fault of code generation is
// caught by random programs within the number that CI runs.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "jit/compiler.h"
#include "jit/ir/planted_fault.h"
#include "tests/fuzz_settings.h"
#include "tests/jit/module_difference.h"
#include "tests/jit/random_module.h"
#include "tests/jit/reduce.h"

namespace kinora::jit::test {
namespace {

struct FaultRow {
    const char* name;
    PlantedFault fault;
    std::string_view where;
    const char* meaning;
};
constexpr FaultRow kFaults[] = {
#define FAULT(name, where, meaning) {#name, PlantedFault::name, where, meaning},
#include "jit/ir/planted_faults.def"
#undef FAULT
};

// What CI runs of each kind of program is 2e5; faults show much sooner.
constexpr uint64_t kPrograms = 60'000;

struct Planted {
    explicit Planted(PlantedFault fault) { planted_fault = fault; }
    ~Planted() { planted_fault = PlantedFault::None; }
};

bool has_target(std::string_view name) {
    const Target* target = find_target(name);
    return target != nullptr && target->supported();
}

// The machine that runs this, or null if there is the interpreter only.
const Target* machine() {
    for (const char* name : {"avx2", "neon"})
        if (has_target(name)) return find_target(name);
    return nullptr;
}

// Faults in a target's emitter need the target.
bool can_show(const FaultRow& row) {
    bool x64 = row.where.find("x64") != row.where.npos,
         a64 = row.where.find("a64") != row.where.npos;
    return (!x64 && !a64) || (x64 && has_target("avx2")) || (a64 && has_target("neon"));
}

Module program(uint64_t seed) {
    const RandomPolicy& policy = kPolicies[seed % static_cast<uint64_t>(kPolicyCount)];
    return random_module(seed, policy, 20 << (seed / static_cast<uint64_t>(kPolicyCount) % 4));
}

// Loops that call functions with arrays, where faults of inlining show: rare in the above.
constexpr RandomPolicy kTurns{"turns", 1, 14, 14, 1, 40, 1, 5, 20, 2};
Module program_for(const FaultRow& row, uint64_t seed) {
    return row.where == "inline" ? random_module(seed, kTurns, 20 << seed % 4) : program(seed);
}

struct Catch {
    uint64_t seed = 0;  // 0: not caught
    char how[200] = "";
};

// Wrong code may do anything, so it runs in a process of its own; its end by a signal is a catch.
Catch hunt(const FaultRow& row) {
    int pipes[2];
    if (pipe(pipes) != 0) return {};
    pid_t child = fork();
    if (child == 0) {
        Planted planted(row.fault);
        for (uint64_t seed = 1; seed <= kPrograms; ++seed) {
            Catch found{seed, "crashed or hung"};
            (void)!write(pipes[1], &found, sizeof found);
            alarm(5);  // wrong code may never end; SIGALRM ends it, which is a catch
            std::string wrong = module_difference(program_for(row, seed), seed);
            if (wrong.empty()) continue;
            snprintf(found.how, sizeof found.how, "%.180s", wrong.c_str());
            (void)!write(pipes[1], &found, sizeof found);
            _exit(0);
        }
        Catch none;
        (void)!write(pipes[1], &none, sizeof none);
        _exit(0);
    }
    close(pipes[1]);
    Catch last, next;
    while (read(pipes[0], &next, sizeof next) == static_cast<ssize_t>(sizeof next)) last = next;
    close(pipes[0]);
    waitpid(child, nullptr, 0);
    return last;
}

// Of passes that know no machine: hunted there where many programs are run.
bool is_of_no_machine(const FaultRow& row) {
    constexpr std::string_view kPasses[] = {"inline", "cse", "fold", "loop_updates"};
    return std::ranges::find(kPasses, row.where) != std::end(kPasses);
}

class PlantedFaults : public testing::TestWithParam<FaultRow> {};

TEST_P(PlantedFaults, IsCaught) {
#if defined(KINORA_SANITIZED)
    GTEST_SKIP() << "generated code is the same without sanitizers, and faster to compile";
#endif
    const FaultRow& row = GetParam();
    if (machine() == nullptr) GTEST_SKIP() << "nearly all are faults of a target";
    if (!can_show(row)) GTEST_SKIP() << "another machine's";
    if (is_of_no_machine(row) && fuzz_setting("KINORA_FUZZ", kPrograms) < kPrograms)
        GTEST_SKIP() << "KINORA_FUZZ asks for few programs";
    Catch found = hunt(row);
    std::string how = found.how;
    std::printf("%-22s %-8s program %5llu  %s\n", row.name, std::string(row.where).c_str(),
                static_cast<unsigned long long>(found.seed), how.substr(0, how.find('\n')).c_str());
    EXPECT_NE(found.seed, 0u) << row.name << ": " << row.meaning;
}
INSTANTIATE_TEST_SUITE_P(Jit, PlantedFaults, testing::ValuesIn(kFaults),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(PlantedFaultRows, ManyAreOfThisMachine) {
    if (machine() == nullptr) GTEST_SKIP() << "this CPU runs the interpreter only";
    EXPECT_GE(std::ranges::count_if(kFaults, can_show), 20);
}

TEST(PlantedFaultRows, NothingIsWrongWithoutThem) {
    for (uint64_t seed = 1; seed <= 200; ++seed)
        ASSERT_EQ(module_difference(program(seed), seed), "") << seed;
}

// The reducer's own test: the fault is known, so a small program must remain.
TEST(Reduce, FindsTheInstructionAtFault) {
    if (machine() == nullptr) GTEST_SKIP() << "this CPU runs the interpreter only";
    const Target& target = *machine();
    Planted planted(PlantedFault::WrongRounding);
    uint64_t seed = 1;
    auto fails = [&](const Module& m) { return !target_difference(m, target, seed).empty(); };
    while (seed < 1000 && !fails(program(seed))) ++seed;
    Module module = program(seed), small = reduce(module, fails);
    EXPECT_TRUE(fails(small));
    size_t instructions = 0;
    bool ceil = false;
    for (const Function& f : small.functions)
        for (const Inst& inst : f.insts) ++instructions, ceil |= inst.op == Op::Ceil;
    EXPECT_TRUE(ceil) << print(small);
    EXPECT_LE(instructions, 16u) << print(small);
    EXPECT_EQ(small.functions.size(), 1u) << print(small);
}

// Not a test: writes a small program for each fault, as tests/jit/kept has them. Run it with
// --gtest_also_run_disabled_tests when random_module changes what it can show.
TEST(Reduce, DISABLED_WritesAProgramForEachPlantedFault) {
    for (const FaultRow& row : kFaults) {
        Catch found = hunt(row);
        if (found.seed == 0 || std::string_view(found.how) == "crashed or hung") continue;
        Planted planted(row.fault);
        Module small = reduce(program_for(row, found.seed), [&](const Module& m) {
            return !module_difference(m, found.seed).empty();
        });
        std::string text = "; " + std::string(row.name) + ": " + row.meaning + "\n; world " +
                           std::to_string(found.seed) + "\n" + print(small);
        std::printf("%s\n", write_reduced(std::string(row.name) + ".ir", text).c_str());
    }
}

}  // namespace
}  // namespace kinora::jit::test
