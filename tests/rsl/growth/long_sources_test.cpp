// tests/rsl/growth/long_sources_test.cpp: sums of 100,000 terms and shaders of thousands of lines:
// what they take grows with their length, and their values are those of a loop.
#include <gtest/gtest.h>

#include <ctime>

#include "rsl/syntax/print.h"
#include "tests/rsl/run_shader.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

double thread_cpu_ms() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

// CPU time of compiling the source whole, to code of the best target.
double whole_compile_ms(const std::string& source) {
    jit::clear_cache();
    const double before = thread_cpu_ms();
    RunShader run(source, {}, {}, false, jit::best_target().name);
    const double after = thread_cpu_ms();
    EXPECT_TRUE(run.ok()) << run.findings();
    return after - before;
}

std::string repeated(int count, const std::string& first, const std::string& more) {
    std::string text = first;
    text.reserve(first.size() + size_t(count) * more.size());
    for (int i = 1; i < count; ++i) text += more;
    return text;
}

// Eight times the text takes eight times as long, and with caches that another program fills up to
// twenty; what is quadratic takes sixty-four. Each is the least of its times.
constexpr double kMostGrowth = 32;
constexpr int kMostRounds = 6;

void expect_growth(const std::string& little, const std::string& much, const std::string& what) {
    double few = 1e30, many = 1e30;
    for (int round = 0; round < kMostRounds; ++round) {
        few = std::min(few, whole_compile_ms(little));
        many = std::min(many, whole_compile_ms(much));
        if (round >= 2 && many < kMostGrowth * few) break;
    }
    printf("   %s: %.0f ms, eight times as many %.0f ms of CPU time\n", what.c_str(), few, many);
    EXPECT_LT(many, kMostGrowth * few) << what;
}

TEST(LongSources, ASumOfAHundredThousandTermsGrowsWithItsTerms) {
    auto source = [](int terms) {
        return "surface t() { float x = " + repeated(terms, "s", " + s") + "; Ci = x; }";
    };
    expect_growth(source(12'500), source(100'000), "12,500 terms");
}

TEST(LongSources, ASumHasTheValueOfALoop) {
    constexpr int kTerms = 100'000;
    const std::string sum =
        "surface t() { float x = " + repeated(kTerms, "s", " + s") + "; Ci = x; }";
    const std::string loop = "surface t() { float x = 0, i; for (i = 0; i < " +
                             std::to_string(kTerms) + "; i += 1) x += s; Ci = x; }";
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader one(sum, {}, {}, false, target.name), other(loop, {}, {}, false, target.name);
        ASSERT_TRUE(one.ok() && other.ok()) << one.findings() << other.findings();
        for (float s : {0.1f, 1.0f, -3.7e-5f}) {
            one.set("s", s), other.set("s", s);
            float expected = 0;
            for (int i = 0; i < kTerms; ++i) expected += s;
            EXPECT_EQ(one.value("Ci.r"), expected) << target.name;
            EXPECT_EQ(other.value("Ci.r"), expected) << target.name;
        }
    }
}

// The reference evaluator and constants of parameters go along the chain too.
TEST(LongSources, ASumOfNumbersIsAConstant) {
    RunShader run("surface t(float x = " + repeated(100'000, "1", " + 1") + ";) { Ci = x; }");
    ASSERT_TRUE(run.ok()) << run.findings();
    EXPECT_EQ(run.shaders[0]->parameters[0].constant->numbers.at(0), 100'000);
}

// Operators and the casts between them, of all kinds: checked, printed, looked at and lowered.
TEST(LongSources, ChainsOfAnyOperatorsCompile) {
    constexpr int kLinks = 20'000;
    const std::string chains[] = {
        "float x = " + repeated(kLinks, "s", " - s * t") + ";",
        "float x = " + repeated(kLinks, "s", " * s / t") + ";",
        "point x = " + repeated(kLinks, "P", " - P + P") + ";",
        "color x = " + repeated(kLinks, "1", " + Cs") + ";",
        "color x = " + repeated(kLinks, "(1, 2, 3)", " * Cs") + ";",
        "vector x = " + repeated(kLinks, "(1, 2, 3)", " + noise(P)") + ";",
        "vector x = " + repeated(kLinks, "N", " ^ I") + ";",
        "float x = " + repeated(kLinks, "s", " < t + s") + " ? 1 : 2;",
        "float x = 0; if (" + repeated(kLinks, "s < t", " && s < t || t < s") + ") x = 1;",
        "float x = " + repeated(kLinks, "s", "--s") + ";",
    };
    for (const std::string& chain : chains) {
        TestSource source("surface t() { " + chain + " Ci = s; }");
        auto shaders = compile(source.source, {}, source.diagnostics);
        ASSERT_EQ(shaders.size(), 1u) << chain.substr(0, 60) << source.messages();
        EXPECT_EQ(source.messages(), "") << chain.substr(0, 60);
        EXPECT_GT(print_ast(*shaders[0]->ast).size(), size_t(kLinks)) << chain.substr(0, 60);
        const Layer layer{shaders[0].get(), {}};
        EXPECT_TRUE(lower({&layer, 1}, {}, source.diagnostics)) << chain.substr(0, 60);
    }
}

TEST(LongSources, AnArrayLengthMayBeASum) {
    RunShader run("surface t() { uniform float x[" + repeated(10'000, "1", " + 1") +
                  "]; Ci = arraylength(x); }");
    ASSERT_TRUE(run.ok()) << run.findings();
    EXPECT_EQ(run.value("Ci.r"), 10'000);
}

// A default that is left out is copied; a class is expanded before it is checked.
TEST(LongSources, ChainsAreCopiedAndExpanded) {
    const std::string sum = repeated(20'000, "1", " + 1");
    RunShader copied("float f(float x = " + sum + ") { return x; } surface t() { Ci = f(); }");
    ASSERT_TRUE(copied.ok()) << copied.findings();
    EXPECT_EQ(copied.value("Ci.r"), 20'000);
    RunShader expanded("class t() { float m = " + sum +
                       "; public void surface(output color Ci, Oi) { Ci = m - " + sum + "; } }");
    ASSERT_TRUE(expanded.ok()) << expanded.findings();
}

TEST(LongSources, ParenthesesHaveALimitThatIsNamed) {
    for (const char* piece : {"s + (", "-(", "abs("}) {
        std::string text = "surface t() { float x = ";
        for (int i = 0; i < 1000; ++i) text += piece;
        text += "s" + std::string(1000, ')') + "; Ci = x; }";
        TestSource source(text);
        EXPECT_TRUE(compile(source.source, {}, source.diagnostics).empty());
        EXPECT_NE(source.messages().find("RSL_TOO_DEEP"), std::string::npos) << piece;
        EXPECT_NE(source.messages().find("at most 400 levels"), std::string::npos)
            << source.messages();
    }
}

// Each is set by the one before it, and live to the end.
std::string with_locals(int locals, const std::string& begin, const char* change) {
    std::string text = "surface t() {", changes, sum = "0";
    for (int i = 0; i < locals; ++i) {
        text += fmt::format(" float x{} = {};\n", i,
                            i == 0 ? "s" : fmt::format("x{} * t + {}", i - 1, i % 7));
        changes += fmt::format(fmt::runtime(change), i, (i + 1) % locals) + "\n";
        sum += fmt::format(" + x{}", i);
    }
    return text + begin + "{" + changes + "}\n Ci = " + sum + "; }";
}

TEST(LongSources, LocalsGrowWithTheirNumber) {
    const std::string loop = "float k; for (k = 0; k < 3; k += 1) ";
    const struct {
        const char* what;
        std::string begin;
        const char* change;
    } kinds[] = {{"read alone", "", ""},
                 {"changed where some points go", "if (s > t) ", "x{} += s;"},
                 {"changed in a loop", loop, "x{} += s;"},
                 {"handed on in a loop", loop, "x{} = x{};"},
                 {"changed by a call", "", "x{} = noise(x{});"}};
    for (const auto& kind : kinds) {
        expect_growth(with_locals(1000, kind.begin, kind.change),
                      with_locals(8000, kind.begin, kind.change),
                      std::string("1,000 locals ") + kind.what);
    }
}

// Text, statements and calls of functions without much in common.
TEST(LongSources, TenThousandLinesGrowWithTheirNumber) {
    auto source = [](int lines) {
        std::string text = "float f(float a, b) { return a * b + 1; }\nsurface t(float k = 1;) {\n";
        text += "  color c = 0; float x = s;\n";
        for (int i = 0; i < lines; i += 4)
            text += fmt::format(
                "  x = f(x, {0}.25);\n  if (x > {0}) x -= k;\n  c += x * color(s, t, {0});\n"
                "  x = mod(x, 3) + abs(t - {0}); // line {0}\n",
                i);
        return text + "  Ci = c; }\n";
    };
    expect_growth(source(1250), source(10'000), "1,250 lines");
}

}  // namespace
}  // namespace kinora::rsl
