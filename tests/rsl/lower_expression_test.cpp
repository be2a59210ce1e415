// tests/rsl/lower_expression_test.cpp: arithmetic, conversions and built-ins as compiled, against
// hand-computed values and the cases of docs/numerics.md.
#include <gtest/gtest.h>

#include <cmath>

#include "rsl/reference/reference.h"
#include "tests/rsl/run_shader.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

TEST(LowerExpression, ComputesArithmetic) {
    EXPECT_EQ(evaluate("1 + 2 * 3"), 7);
    EXPECT_EQ(evaluate("x * x - 1", "float x = s + 3;"), 8);
    EXPECT_EQ(evaluate("(1 < 2) + (2 < 1)"), 1);
    EXPECT_EQ(evaluate("s > 0 ? 1 : 2"), 2);
}

TEST(LowerExpression, DividesAsRslDoes) {
    EXPECT_EQ(evaluate("1 / s"), 0);  // docs/numerics.md#division
    EXPECT_EQ(evaluate("0 / 0"), 0);
    EXPECT_EQ(evaluate("1 / (s + 1e-40)"), 0);
    EXPECT_EQ(evaluate("1 / (s + 4)"), 0.25f);
}

struct Case {
    const char* expression;
    float value;
};

class EdgeRows : public testing::TestWithParam<Case> {};

TEST_P(EdgeRows, HaveTheirOutcome) {
    // zero is varying, so that nothing folds.
    EXPECT_FLOAT_EQ(evaluate(GetParam().expression, "float zero = s;"), GetParam().value)
        << GetParam().expression;
}

INSTANTIATE_TEST_SUITE_P(
    Extremes, EdgeRows,
    testing::Values(Case{"pow(zero - 2, 0.5)", 0}, Case{"pow(zero - 2, zero + 3)", -8},
                    Case{"pow(zero - 2, 2)", 4}, Case{"pow(zero, zero)", 1},
                    Case{"pow(zero, zero - 1)", 0}, Case{"sqrt(zero - 1)", 0},
                    Case{"inversesqrt(zero)", 0}, Case{"inversesqrt(zero - 1)", 0},
                    Case{"log(zero)", -87.336544f}, Case{"acos(zero + 1.000001)", 0},
                    Case{"asin(zero - 2)", -1.5707964f}, Case{"atan(zero, zero)", 0},
                    Case{"mod(zero - 0.25, 1)", 0.75f}, Case{"mod(zero + 5, -3)", -1},
                    Case{"mod(zero + 5, zero)", 0}, Case{"smoothstep(1, 1, zero)", 0},
                    Case{"smoothstep(1, 1, zero + 1)", 1}, Case{"smoothstep(1, 0, zero + 0.5)", 0},
                    Case{"step(zero + 2, 2)", 1}, Case{"clamp(zero + 5, 3, 1)", 1},
                    Case{"clamp(zero + 2, 3, 1)", 3}, Case{"length(vector(zero, 0, 0))", 0},
                    Case{"xcomp(normalize(vector(zero, 0, 0)))", 0},
                    Case{"xcomp(normalize(vector(zero + 1e-30, 0, 0)))", 1},
                    Case{"xcomp(normalize(vector(zero + 1e30, 0, 0)))", 1},
                    Case{"length(vector(zero + 1e20, 1e20, 1e20))", 1.7320508e20f},
                    // The point comes last.
                    Case{"ptlined(point (0, 0, 0), point (9, 0, 0), point (zero + 5, 7, 0))", 7},
                    Case{"ptlined(point (0, 0, 0), point (2, 0, 0), point (zero + 5, 4, 0))", 5},
                    Case{"spline(zero - 1, 0, 1, 2, 3)", 1},
                    Case{"spline(zero + 2, 0, 1, 2, 3)", 2},
                    Case{"spline(zero + 0.5, 0, 1, 2, 3)", 1.5f},
                    Case{"float noise(point(zero + 3, 5, 7))", 0.5f}, Case{"round(zero - 2.5)", -2},
                    Case{"round(zero + 2.5)", 3}, Case{"sign(zero - 3)", -1},
                    Case{"comp(color(1, 2, 3), zero + 9)", 3}));

TEST(LowerExpression, FoldsProductsWithZero) {
    RunShader shader("surface t(float k = 0;) { Ci = k * noise(P); Oi = 1; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_EQ(shader.kernels.point->inputs.size(), 0u);
    EXPECT_EQ(shader.lowered.opacity, LoweredShader::Opacity::Opaque);
}

TEST(LowerExpression, KeepsTripleComponents) {
    RunShader shader(
        "surface t() { color c = color(1, 2, 3); c[1] = 7; vector v = vector c; Ci = c; Oi = "
        "color(v . vector(1, 1, 1)); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    auto out = shader.run();
    EXPECT_EQ(out["Ci.g"][0], 7);
    EXPECT_EQ(out["Oi.r"][0], 11);
}

TEST(LowerExpression, InvertsMatrices) {
    EXPECT_NEAR(
        evaluate("comp(m * (1 / m), 2, 2)", "matrix m = (2,0,0,0, 1,3,0,0, 0,s,4,0, 5,6,7,1);"), 1,
        1e-6);
    EXPECT_NEAR(evaluate("determinant(m)", "matrix m = (2,0,0,0, 1,3,0,0, 0,s,4,0, 5,6,7,1);"), 24,
                1e-5);
    EXPECT_EQ(evaluate("xcomp(transform(translate(m, vector(1, 2, 3)), point(1, 1, 1)))",
                       "matrix m = 1;"),
              2);
}

TEST(LowerExpression, ConvertsColorSpaces) {
    EXPECT_NEAR(evaluate("comp(color \"hsv\" (1/3, 1, 1), 1)"), 1, 1e-6);
    EXPECT_NEAR(evaluate("comp(ctransform(\"hsv\", color(0.5, 0.5, 0.5)), 0)"), 0, 0);
    EXPECT_NEAR(evaluate("comp(ctransform(\"hsl\", color(0.25, 0.5, 0.75)), 2)"), 0.5, 1e-6);
    EXPECT_NEAR(evaluate("comp(ctransform(\"xyY\", \"rgb\", ctransform(\"xyY\", color(0.2, 0.5, "
                         "0.7))), 2)"),
                0.7, 1e-4);
}

TEST(LowerExpression, AnUnknownCoordinateSystemIsShader) {
    std::vector<std::string> spaces = {"node7"};
    LowerOptions options;
    options.spaces = &spaces;
    RunShader shader(
        "surface t() { point p = transform(\"shadr\", P), q = transform(\"shadr\", P + 1);"
        " Ci = color(xcomp(p), xcomp(q), xcomp(transform(\"node7\", P))); }",
        options);
    ASSERT_TRUE(shader.ok()) << shader.findings();
    ASSERT_EQ(shader.diagnostics.findings().size(), 1u) << shader.findings();
    const Finding& finding = shader.diagnostics.findings()[0];
    EXPECT_EQ(finding.severity, Severity::Warning);
    EXPECT_NE(shader.findings().find("test.sl:1"), std::string::npos);
    EXPECT_EQ(finding.help, "did you mean 'shader'?");
    std::string moved = text(space_key("shader", false, 0, 3));
    shader.set(moved, 7);
    shader.set3("P", 2, 0, 0);
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 9);
    EXPECT_EQ(out["Ci.g"][0], 10);
    EXPECT_EQ(out["Ci.b"][0], 2);

    ReferenceInputs inputs;  // the language's own definition says the same
    inputs.spaces = &spaces;
    inputs.values = {{"P.x", 2}, {moved, 7}};
    Layer layer{shader.shaders.back().get(), {}};
    ReferenceResult want = run_reference<double>({&layer, 1}, inputs);
    EXPECT_EQ(want.values["Ci.r"], 9);
    EXPECT_EQ(want.values["Ci.b"], 2);
}

TEST(LowerExpression, AnUnknownCoordinateSystemIsAnErrorWhereThatIsWanted) {
    std::vector<std::string> spaces;
    LowerOptions options;
    options.spaces = &spaces;
    TestSource source("surface t() { Ci = color(xcomp(transform(\"shadr\", P))); }");
    source.diagnostics.set_severity("RSL_SPACE_UNKNOWN", Severity::Error);
    auto shaders = compile(source.source, {}, source.diagnostics);
    ASSERT_EQ(shaders.size(), 1u);
    Layer layer{shaders[0].get(), {}};
    EXPECT_FALSE(lower({&layer, 1}, options, source.diagnostics));
    EXPECT_TRUE(source.diagnostics.has_errors());
}

// Without a scene any name may be a node's: only what looks like a slip is hinted at.
TEST(LowerExpression, HintsAtCoordinateSystemsThatLookMisspelt) {
    auto help = [](const std::string& name) {
        RunShader shader("surface t() { Ci = color(xcomp(transform(\"" + name + "\", P))); }");
        EXPECT_TRUE(shader.ok());
        return shader.diagnostics.findings().empty() ? "" : shader.diagnostics.findings()[0].help;
    };
    EXPECT_EQ(help("shadr"), "did you mean 'shader'?");
    EXPECT_EQ(help("wrold"), "did you mean 'world'?");
    EXPECT_EQ(help("obejct"), "did you mean 'object'?");
    for (const char* name : {"world", "projector", "lamp", "camera1", "object_2", "table"})
        EXPECT_EQ(help(name), "") << name;
}

TEST(LowerExpression, ReportsWhatItCannotCompile) {
    RunShader large("surface t(float i = 0;) { float a[200000]; a[s] = 1; Ci = a[t]; }");
    EXPECT_NE(large.findings().find("array 'a' is too large"), std::string::npos)
        << large.findings();
}

TEST(LowerExpression, FunctionsAreChosenByTheirResult) {
    RunShader shader(
        "float f(float x) { return 10 * x; } color f(float x) { return color(x, 0, 1); }"
        "surface t() { color c = f(2); float g = f(3); Ci = c + g + 100 * color f(5); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 2 + 30 + 500);
    EXPECT_EQ(out["Ci.g"][0], 30);
    EXPECT_EQ(out["Ci.b"][0], 1 + 30 + 100);
}

// `count` arrays of 1000 KiB at 16 points, each read and written at varying indices.
std::string many_arrays(int count) {
    std::string body;
    for (int k = 0; k < count; ++k) {
        std::string a = "a" + std::to_string(k);
        body += "float " + a + "[16000]; " + a + "[s * 9] = t; r += " + a + "[t * 9];\n";
    }
    return "surface t() { float r = 0;\n" + body + "Ci = r; }";
}

TEST(LowerExpression, ArraysThatAreTooLargeTogetherAreOneErrorThatNamesTheOneTooMany) {
    EXPECT_TRUE(RunShader(many_arrays(16)).ok());
    RunShader large(many_arrays(40));
    EXPECT_FALSE(large.ok());
    std::string findings = large.findings();
    EXPECT_NE(findings.find("test.sl:18"), std::string::npos) << findings;
    EXPECT_NE(findings.find("array 'a16' brings"), std::string::npos) << findings;
    EXPECT_EQ(findings.find("array 'a17'"), std::string::npos) << findings;
}

TEST(LowerExpression, ArraysOfFunctionsThatCallThemselvesCountOftener) {
    auto shader = [](int length) {
        return "float f(float n) { float a[" + std::to_string(length) +
               "]; a[n * 3] = s; if (n < 1) return a[0]; return f(n - 1) + a[n]; }\n"
               "surface t() { Ci = f(60 * s); }";
    };
    EXPECT_TRUE(RunShader(shader(1000)).ok());
    RunShader large(shader(16000));
    EXPECT_NE(large.findings().find("array 'a' brings"), std::string::npos) << large.findings();
}

}  // namespace
}  // namespace kinora::rsl
