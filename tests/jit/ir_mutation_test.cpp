// tests/jit/ir_mutation_test.cpp: damaged IR text ends in a finding, or in a module that passes and
// the interpreter take. KINORA_FUZZ_TEXT=N sets how many.
#include <gtest/gtest.h>

#include "jit/compiler.h"
#include "jit/interp/interp.h"
#include "jit/passes/passes.h"
#include "tests/fuzz_settings.h"
#include "tests/jit/random_module.h"
#include "tests/mutate.h"

namespace kinora::jit::test {
namespace {

constexpr uint64_t kDefaultTexts = 3000;

std::vector<std::string> words() {
    std::vector<std::string> list = {"%0",         "%1",          "%7",     "%99",  "#0",    "#1",
                                     "#-1",        "#2147483647", "f",      "i",    "m",     "nan",
                                     "0x7fc00000", "()",          "->",     ",",    "end\n", "\"",
                                     ";",          "function",    "module", "input"};
    for (const OpInfo& op : kOps) {
        std::string name = op.name;
        for (char& c : name) c = static_cast<char>(std::tolower(c));
        list.push_back(name);
    }
    return list;
}

TEST(IrMutation, DamagedTextEndsInAFindingOrAModule) {
    std::vector<std::string> corpus;
    for (uint64_t seed = 0; seed < 20; ++seed)
        corpus.push_back(print(random_module(seed, kPolicies[seed % 5], 12)));
    Mutator mutator(std::move(corpus), words(), fuzz_setting("KINORA_FUZZ_SEED", 1), 2);
    size_t texts = 0, modules = 0;
    for (uint64_t k = fuzz_setting("KINORA_FUZZ_TEXT", kDefaultTexts); k > 0; --k, ++texts) {
        std::string text = mutator.next();
        Diagnostics diagnostics;
        Module module = parse_module(text, "mutated.ir", diagnostics);
        ASSERT_EQ(module.functions.empty(), diagnostics.has_errors()) << text;
        if (module.functions.empty()) continue;
        ++modules;
        ASSERT_EQ(verify(module), "") << text;
        ASSERT_EQ(print(parse_module(print(module), "again.ir", diagnostics)), print(module));
        Module frame;
        optimize(module, &frame);
        ASSERT_EQ(verify(module) + verify(frame), "") << text;
        ASSERT_NE(emit_interp(module, nullptr), nullptr);
    }
    std::printf("%zu texts, %zu modules\n", texts, modules);
    EXPECT_GT(modules * 200, texts);
}

}  // namespace
}  // namespace kinora::jit::test
