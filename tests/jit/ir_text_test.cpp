// tests/jit/ir_text_test.cpp: IR text reads back to what was printed; errors have their position.
#include <gtest/gtest.h>

#include "jit/ir/ir.h"
#include "tests/jit/random_module.h"

namespace kinora::jit {
namespace {

TEST(IrText, RoundTripsRandomModules) {
    for (uint64_t seed = 0; seed < 500; ++seed) {
        Module module = test::random_module(seed, test::kPolicies[seed % 5], 60);
        std::string text = print(module);
        Diagnostics diagnostics;
        Module read = parse_module(text, "random.ir", diagnostics);
        ASSERT_FALSE(diagnostics.has_errors())
            << format_finding(diagnostics.findings()[0], diagnostics.files);
        ASSERT_EQ(print(read), text);
    }
}

TEST(IrText, KeepsFloatsBitForBit) {
    for (int k = 0; k < test::kEdgeFloatCount; ++k) {
        int32_t bits = bits_of(test::kEdgeFloats[k]);
        Module module;
        module.functions.resize(1);
        module.functions[0].results = {Type::F};
        module.outputs = {{"x", Type::F}};
        module.functions[0].insts = {{.op = Op::ConstF, .type = Type::F, .imm = bits},
                                     {.op = Op::Return, .arg_count = 1}};
        module.functions[0].args = {0};
        Diagnostics diagnostics;
        Module read = parse_module(print(module), "x.ir", diagnostics);
        ASSERT_EQ(read.functions.size(), 1u) << print(module);
        EXPECT_EQ(read.functions[0].insts[0].imm, bits);
    }
}

// Text, and where and what the finding is.
struct Case {
    const char* text;
    const char* finding;
};
const Case kCases[] = {
    {"module \"a\" budget 1 slots 0\nfunction \"k\" () -> ()\n  %0 = frob %1\n  return\nend\n",
     "x.ir:3:8: error: no op is named 'frob'"},
    {"function \"k\" () -> ()\n  %0 = constf zero\n  return\nend\n",
     "x.ir:2:15: error: expected a number"},
    {"function \"k\" () -> ()\n  %1 = constf 0\n  return\nend\n", "x.ir:2:4: error: expected %0"},
    {"function \"k\" () -> ()\n  return\n", "x.ir:3:1: error: expected 'end'"},
    {"function \"k\" () -> ()\n  %0 = consti #1\n  %1 = add %0, %0\n  return\nend\n",
     "error: k: %1 Add: a %0 is i, not f"},
};

TEST(IrText, ReportsErrorsAtTheirPosition) {
    for (const Case& c : kCases) {
        Diagnostics diagnostics;
        Module module = parse_module(c.text, "x.ir", diagnostics);
        EXPECT_TRUE(module.functions.empty());
        ASSERT_EQ(diagnostics.findings().size(), 1u) << c.text;
        std::string text = format_finding(diagnostics.findings()[0], diagnostics.files);
        EXPECT_NE(text.find(c.finding), std::string::npos) << text << "\nwanted: " << c.finding;
    }
}

TEST(IrText, TruncatedTextNeverCrashes) {
    std::string text = print(test::random_module(3, test::kPolicies[3], 30));
    for (size_t size = 0; size < text.size(); size += 7) {
        Diagnostics diagnostics;
        parse_module(std::string_view(text).substr(0, size), "cut.ir", diagnostics);
    }
}

}  // namespace
}  // namespace kinora::jit
