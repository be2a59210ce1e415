// tests/rsl/strings_test.cpp: strings that are made, compared and matched, when the shader is
// compiled and when it runs.
#include <gtest/gtest.h>

#include <regex>
#include <thread>

#include "jit/target.h"
#include "rsl/model/text_table.h"
#include "runtime/base/check.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

// The string that `expression` gives at s = 0 and s = 1, on each target. VS is "ab" at 0, "xy"
// at 1.
std::vector<std::string> texts(const std::string& expression) {
    std::vector<std::string> first;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        LowerOptions options;
        options.aovs = {"r"};
        RunShader run(
            "surface t(output varying string r = \"\"; string S = \"plain\";) {"
            " string VS = s > 0.5 ? \"xy\" : \"ab\"; r = " +
                expression + "; Ci = 1; }",
            options, {}, false, target.name);
        EXPECT_TRUE(run.ok()) << run.findings();
        if (!run.ok()) return {"", ""};
        run.set("s", std::vector<float>{0, 1});
        std::vector<std::string> got;
        auto outputs = run.run(2);
        for (float id : outputs["aov:r"]) got.push_back(interned(std::bit_cast<int32_t>(id)));
        if (first.empty()) first = got;
        EXPECT_EQ(got, first) << target.name;
    }
    return first;
}

using Two = std::vector<std::string>;

TEST(Strings, AreJoinedWhenCompiledAndWhenRun) {
    EXPECT_EQ(texts("concat(\"a\", S, \"b\")"), (Two{"aplainb", "aplainb"}));
    EXPECT_EQ(texts("concat(\"<\", VS, \">\", S)"), (Two{"<ab>plain", "<xy>plain"}));
    EXPECT_EQ(texts("concat(VS, VS)"), (Two{"abab", "xyxy"}));
}

TEST(Strings, AreFormattedWhenCompiledAndWhenRun) {
    EXPECT_EQ(texts("format(\"%f %d %s%%\", 0.5, 7.9, S)"), (Two{"0.5 7 plain%", "0.5 7 plain%"}));
    EXPECT_EQ(texts("format(\"%f|%s\", s + 0.25, VS)"), (Two{"0.25|ab", "1.25|xy"}));
    EXPECT_EQ(texts("format(\"tex.%04d.tif\", s + 12)"), (Two{"tex.0012.tif", "tex.0013.tif"}));
    EXPECT_EQ(texts("format(\"%5.2f%%\", s)"), (Two{" 0.00%", " 1.00%"}));
    EXPECT_EQ(texts("format(\"%c %p\", color(s, 0, 1), point(1, 2, s))"),
              (Two{"0 0 1 1 2 0", "1 0 1 1 2 1"}));
    EXPECT_EQ(texts("format(VS, s)"), (Two{"ab", "xy"}));
}

// A string doubled `rounds` times; what becomes of it is its length, as far as a pattern tells.
TEST(Strings, OfMoreThan64KiBAreNotMadeAndTheShaderSaysSo) {
    for (std::string make : {"concat(a, a)", "format(\"%s%s\", a, a)"})
        for (int rounds : {16, 17, 40})
            for (const jit::Target& target : jit::targets()) {
                if (!target.supported()) continue;
                SCOPED_TRACE(make + " " + std::to_string(rounds) + " " + target.name);
                LowerOptions options;
                options.aovs = {"r"};
                RunShader run(
                    "surface t(output varying string r = \"\";) { string a = \"x\";"
                    " float i; for (i = 0; i < " +
                        std::to_string(rounds) + " + s; i += 1) { a = " + make +
                        "; if (match(\"more\", a)) break; }"
                        " r = a; Ci = 1; }",
                    options, {}, false, target.name);
                ASSERT_TRUE(run.ok()) << run.findings();
                run.set("s", std::vector<float>{0, 0});
                auto outputs = run.run(2);
                const std::string& made = interned(std::bit_cast<int32_t>(outputs["aov:r"][0]));
                EXPECT_EQ(run.faults, rounds > 16 ? 1 : 0);
                EXPECT_EQ(made, rounds > 16 ? std::string(kTooLong) : std::string(65536, 'x'));
            }
}

TEST(Strings, OfMoreThan64KiBThatAreKnownWhenTheShaderIsCompiledAreErrors) {
    std::string big(40000, 'y');
    for (std::string make : {"concat(\"" + big + "\", \"" + big + "\")",
                             "format(\"%s%s\", \"" + big + "\", \"" + big + "\")"}) {
        RunShader run("surface t(output varying string r = \"\";) {\n r = " + make + "; }");
        EXPECT_FALSE(run.ok());
        EXPECT_NE(run.findings().find("test.sl:2"), std::string::npos);
        EXPECT_NE(run.findings().find("a string of more than 65536 bytes"), std::string::npos);
    }
}

TEST(Strings, OfMoreNumbersThanAServiceTakesAreMadeInParts) {
    std::string matrix = "matrix(s,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15)";
    std::string tail = "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15";
    EXPECT_EQ(texts("format(\"<%m> <%m> %f\", " + matrix + ", " + matrix + ", s)"),
              (Two{"<0 " + tail + "> <0 " + tail + "> 0", "<1 " + tail + "> <1 " + tail + "> 1"}));
}

TEST(Strings, AreMatchedWhenRun) {
    EXPECT_EQ(texts("match(\"^a.$\", VS) == 1 ? \"yes\" : \"no\""), (Two{"yes", "no"}));
    EXPECT_EQ(texts("match(VS, \"axyz\") == 1 ? \"yes\" : \"no\""), (Two{"no", "yes"}));
}

TEST(Strings, MatchAsPosixDoes) {
    const char* patterns[] = {
        "",         "a",     "^a",       "b$",       "a.c",  "ab*c",   "ab+c",
        "ab?c",     "[abc]", "[^abc]+$", "^[a-c]+$", "a|bc", "(ab)+c", "^(a|b)*$",
        "x(y|z)*$", "\\.",   "[0-9]+",   "^$",       "a*",   "(a*)*b", "tex[0-9]\\.tif$",
        "((a)b)c"};
    const char* words[] = {"",     "a",     "ab",  "abc", "abbc", "ac",       "bc",      "xyz",
                           "xzzy", "ababc", "a.c", "12",  "q",    "tex7.tif", "tex.tif", "aaaaac"};
    for (const char* pattern : patterns)
        for (const char* word : words) {
            if (std::string_view(pattern).empty()) {
                EXPECT_TRUE(matches(pattern, word));
                continue;
            }
            bool expected = std::regex_search(word, std::regex(pattern, std::regex::extended));
            EXPECT_EQ(matches(pattern, word), expected) << pattern << " in " << word;
        }
}

TEST(Strings, MatchTakesBrokenPatternsWithoutHarm) {
    for (const char* pattern : {"(", ")", "[", "[^", "*", "a**", "\\", "((((", "|", "(|)", "[z-a]"})
        matches(pattern, "some text");
    std::string hostile;
    for (int k = 0; k < 200; ++k) hostile += "(a*)*";
    EXPECT_FALSE(matches("^" + hostile + "b$", std::string(2000, 'a')));
}

TEST(Strings, PrintIsKeptAndComesInPiecesOfItsFormat) {
    static std::vector<std::string> printed;
    printed.clear();
    RunShader run(
        "surface t() { matrix m = s; printf(\"a %m b %m\\n\", m, m); debug(s); Ci = 0; }");
    ASSERT_TRUE(run.ok()) << run.findings();
    run.services[Service::print] = [](const jit::ServiceCall& call) {
        std::vector<float> values;
        for (int k = 0; k < kMostFormatValues; ++k)
            values.push_back(call.args[(1 + k) * jit::kMaxLanes]);
        printed.push_back(format_text(interned(jit::bits_of(call.args[0])), values));
    };
    run.set("s", 2);
    run.run(1);
    ASSERT_EQ(printed.size(), 3u);
    EXPECT_EQ(printed[0] + printed[1],
              "a 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 2 b 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 2\n");
    EXPECT_EQ(printed[2], "debug float: 2\n");
}

TEST(Strings, OpacityKernelsDoNotPrint) {
    LowerOptions options;
    options.want_Ci = false;
    RunShader run("surface t() { printf(\"x\\n\"); Oi = 0.5; Ci = 1; }", options);
    ASSERT_TRUE(run.ok()) << run.findings();
    EXPECT_TRUE(run.kernels.point->services.empty());
}

// More texts than the first blocks hold; threads add the same and different ones, and read.
TEST(TextTable, KeepsNumbersAndAddressesWhileThreadsAdd) {
    TextTable table;
    EXPECT_EQ(table.id(""), 0);
    const std::string& first = table.text(table.id("first"));
    std::vector<std::vector<int32_t>> found(4);
    {
        std::vector<std::jthread> threads;
        for (std::vector<int32_t>& ids : found)
            threads.emplace_back([&] {
                for (int k = 0; k < 3000; ++k) {
                    ids.push_back(table.id("text " + std::to_string(k)));
                    EXPECT_EQ(table.text(ids[size_t(k) / 2]), "text " + std::to_string(k / 2));
                }
            });
    }
    for (const std::vector<int32_t>& ids : found) EXPECT_EQ(ids, found[0]);
    EXPECT_EQ(table.count(), 3002);
    EXPECT_EQ(&first, &table.text(1));
    EXPECT_EQ(first, "first");
    EXPECT_THROW(table.text(3002), CheckFailed);
}

}  // namespace
}  // namespace kinora::rsl
