// tests/jit/verify_test.cpp: each rule of the IR, broken once, is named precisely.
#include <gtest/gtest.h>

#include "jit/ir/ir.h"

namespace kinora::jit {
namespace {

// The body of a kernel `() -> (f)` in a small module, and the fault that verify must name.
struct Case {
    const char* body;
    const char* fault;
};
const Case kCases[] = {
    {"%0 = constf 1\nreturn [%0]\n", ""},
    {"%0 = constf 1\n%1 = add %0, %1\nreturn [%1]\n", "b %1 is not defined before"},
    {"%0 = consti #1\n%1 = neg %0\nreturn [%1]\n", "a %0 is i, not f"},
    {"%0 = constf 1\n", "does not end with a return"},
    {"%0 = constf 1\nreturn\n", "takes 1 arguments, not 0"},
    {"%0 = consti #1\n%1 = ishl %0, #32\n%2 = constf 0\nreturn [%2]\n",
     "shift count 32 is not in 0..31"},
    {"%0 = constm #1\nif %0\n%2 = constf 1\nendif #1\n%4 = neg %2\nreturn [%4]\n",
     "a %2 is out of scope"},
    {"%0 = constm #1\n%1 = constf 0\nif %0\n%3 = constf 1\nendif #2\n%5 = constf 2\n"
     "%6 = merge.f %3, %1, #2\nreturn [%6]\n",
     "a merge follows its endif"},
    {"%0 = constm #1\nif %0\n%2 = constf 1\nendif #1\n%4 = merge.f %2, %2, #1\nreturn [%4]\n",
     "b %2 is not visible before the if"},
    {"%0 = constm #1\n%1 = constf 0\n%2 = loop %0\n%3 = loopvar.f %1, #2\nendloop %2, #2\n"
     "return [%1]\n",
     "gives 0 values for 1 loop variables"},
    {"%0 = constm #1\n%1 = loop %0\n%2 = constf 0\n%3 = loopvar.f %2, #1\nendloop %1, #1, [%2]\n"
     "return [%2]\n",
     "a loop variable follows its loop"},
    {"%0 = constm #1\n%1 = constf 0\n%2 = loop %0, #5\nendloop %2, #2\nreturn [%1]\n",
     "fault site 5 is not in 0..0"},
    {"%0 = constm #1\n%1 = constf 0\nif %0\nreturn [%1]\n", "function's end only"},
    {"%0 = constm #1\n%1 = constf 0\nservice %0, [%1]\nreturn [%1]\n", "results of %2 are missing"},
    {"%0 = constm #1\n%1 = constf 0\nservice %0, [%1 %1]\n%3 = result.f %2\nreturn [%1]\n",
     "takes 1 arguments, not 2"},
    {"%0 = constm #1\n%1 = constf 0\ncall %0\n%3 = result.f %2\nreturn [%1]\n", "calls itself"},
    {"%0 = input.i\n%1 = constf 0\nreturn [%1]\n", "input 0 is of another type"},
    {"%0 = constf 0\n%1 = frameload.f #3\nreturn [%0]\n", "frame slot 3 is not in 0..1"},
    {"%0 = consti\n%1 = lookup %0, #0, #7\nreturn [%1]\n", ""},
    {"%0 = consti\n%1 = lookup %0, #0, #3\nreturn [%1]\n", "looks at 3 bits"},
    {"%0 = consti\n%1 = lookup %0, #1, #7\nreturn [%1]\n", "last constant 8 is not in 0..7"},
    {"%0 = consti\n%1 = arrayload.f %0\n%2 = constf 0\nreturn [%2]\n", "array 0 is not in 0..-1"},
};

TEST(Verify, NamesTheBrokenRule) {
    for (const Case& c : kCases) {
        std::string text =
            "module \"m\" budget 10 slots 2\ntable 1 2 3 4 5 6 7 8\ninput \"x\" f point\noutput "
            "\"y\" f\n"
            "service \"s\" (f) -> (f)\nfault \"loop\"\nfunction \"kernel\" () -> (f)\n";
        text += std::string(c.body) + "end\n";
        Diagnostics diagnostics;
        parse_module(text, "m.ir", diagnostics);
        std::string got = diagnostics.findings().empty() ? "" : diagnostics.findings()[0].message;
        if (std::string_view(c.fault).empty())
            EXPECT_EQ(got, "") << text;
        else
            EXPECT_NE(got.find(c.fault), std::string::npos)
                << text << "\ngot: " << got << "\nwanted: " << c.fault;
    }
}

}  // namespace
}  // namespace kinora::jit
