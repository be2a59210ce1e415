// tests/rsl/lower_control_test.cpp: branches, loops, jumps, functions and arrays as compiled, with
// lanes that go different ways.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "jit/target.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

// Runs a surface on points s = 0, 1, 2, ... and gives Ci.r of each.
std::vector<float> run_on(const std::string& source, int count = 20) {
    RunShader shader(source);
    EXPECT_TRUE(shader.ok()) << shader.findings();
    if (!shader.ok()) return {};
    std::vector<float> s;
    for (int k = 0; k < count; ++k) s.push_back(float(k));
    shader.set("s", s);
    return shader.run(count)["Ci.r"];
}

// Compares with a scalar program.
template <class F>
void expect_each(const std::string& body, F&& scalar, const std::string& before = "") {
    std::vector<float> got = run_on(before + "surface t() { float r = 0; " + body + " Ci = r; }");
    for (size_t k = 0; k < got.size(); ++k)
        EXPECT_EQ(got[k], scalar(int(k))) << body << " at s = " << k;
}

TEST(LowerControl, BranchesPerLane) {
    expect_each("if (s > 5) r = 1; else if (s > 2) r = 2; else { r = 3; r += s; }", [](int s) {
        return s > 5 ? 1.f : s > 2 ? 2.f : 3.f + float(s);
    });
}

TEST(LowerControl, LoopsEndPerLane) {
    expect_each("float i; for (i = 0; i < s; i += 1) r += i;",
                [](int s) { return float(s * (s - 1) / 2); });
    expect_each("float i = s; while (i > 0) { r += 1; i -= 2; }",
                [](int s) { return float((s + 1) / 2); });
}

TEST(LowerControl, BreakAndContinueLeaveTheRightLanes) {
    expect_each(
        "float i; for (i = 0; i < 10; i += 1) { if (i == s) break; if (mod(i, 2) == 1) continue; r "
        "+= i + 1; } r += 100 * i;",
        [](int s) {
            float r = 0;
            int i;
            for (i = 0; i < 10; ++i) {
                if (i == s) break;
                if (i % 2) continue;
                r += float(i + 1);
            }
            return r + 100 * float(i);
        });
}

TEST(LowerControl, JumpsTakeLevels) {
    expect_each(
        "float i, j; for (i = 0; i < 5; i += 1) { for (j = 0; j < 5; j += 1) { if (i * j > s) "
        "break 2; if (i + j == 4) continue 2; r += 1; } r += 10; } r += 1000 * i;",
        [](int s) {
            float r = 0;
            int i, j;
            for (i = 0; i < 5; ++i) {
                bool next = false;
                for (j = 0; j < 5; ++j) {
                    if (i * j > s) goto out;
                    if (i + j == 4) {
                        next = true;
                        break;
                    }
                    r += 1;
                }
                if (next) continue;
                r += 10;
            }
        out:
            return r + 1000 * float(i);
        });
}

TEST(LowerControl, FunctionsReturnFromAnywhere) {
    expect_each(
        "r = f(s);",
        [](int s) {
            if (s < 3) return 10.f;
            for (int i = 0; i < 100; ++i)
                if (i * i > s) return float(i);
            return -1.f;
        },
        "float f(float x;) { float i; if (x < 3) return 10; for (i = 0; i < 100; i += 1) { "
        "if (i * i > x) return i; } return -1; }\n");
}

TEST(LowerControl, FunctionsThatDoubleAtEachLevelAreAnError) {
    std::string source = "float f0(float x) { return x + 1; }\n";
    for (int k = 1; k <= 40; ++k)
        source += fmt::format("float f{0}(float x) {{ return f{1}(x * 0.5) + f{1}(x + 0.1); }}\n",
                              k, k - 1);
    RunShader deep(source + "surface t() { Ci = f40(s); }");
    EXPECT_FALSE(deep.ok());
    EXPECT_NE(deep.findings().find("functions in place of their calls"), std::string::npos);
    EXPECT_TRUE(RunShader(source + "surface t() { Ci = f10(s); }").ok());
}

TEST(LowerControl, OutputParametersAreCopiedBack) {
    expect_each(
        "float a = s; if (s > 4) { r = twice(a); r += a; } else r = a;",
        [](int s) { return s > 4 ? float(s) + float(2 * s) : float(s); },
        "float twice(output float x;) { float old = x; x *= 2; return old; }\n");
}

TEST(LowerControl, OutputParametersAreTheVariablesGivenForThem) {
    expect_each(
        "float a = s; if (s > 4) both(a, a); r = a;", [](int s) { return s > 4 ? 6.f : float(s); },
        "void both(output float x, y;) { y = 5; x += 1; }\n");
    expect_each(
        "float k = s; float f(output float x;) { extern float k; x = 5; k += 1; return k; }"
        "float whole = f(k); r = 10 * whole + k;",
        [](int) { return 66.f; });
    // Through two calls and a loop, to a global; elements are copied in and out.
    expect_each(
        "float i; for (i = 0; i < 3; i += 1) outer(s, s); r = s;",
        [](int s) { return float(s + 12); },
        "void inner(output float x; output float y;) { float j; for (j = 0; j < 2; j += 1) { x += "
        "1;"
        " y += 1; } }\nvoid outer(output float x; output float y;) { inner(y, x); }\n");
    expect_each(
        "float a[2] = {1, 2}; swap(a[0], a[1]); r = 10 * a[0] + a[1] + s;",
        [](int s) { return float(21 + s); },
        "void swap(output float x, y;) { float old = x; x = y; y = old; }\n");
}

TEST(LowerControl, OtherParametersAreValues) {
    expect_each(
        "float a = s; twice(a, a); r = a;", [](int s) { return float(3 * s); },
        "void twice(output float x; float y;) { x += y; x += y; }\n");
    expect_each(
        "float a[2]; a[0] = s; a[1] = 1; turn(a, a); r = 10 * a[0] + a[1];",
        [](int s) { return float(10 + s); },
        "void turn(output float x[2]; float y[2];) { x[0] = y[1]; x[1] = y[0]; }\n");
}

TEST(LowerControl, NestedFunctionsSeeTheirSurroundings) {
    expect_each(
        "float k = 3; float f(float x;) { extern float k; k += 1; return x * k; } r = f(s) "
        "+ f(1); r += k;",
        [](int s) { return float(s * 4 + 5 + 5); });
}

TEST(LowerControl, ArraysAreIndexedPerLane) {
    expect_each(
        "float a[4] = {10, 20, 30, 40}; a[mod(s, 4)] += 5; float i; for (i = 0; i < 4; i "
        "+= 1) r += (i + 1) * a[i];",
        [](int s) {
            float a[4] = {10, 20, 30, 40};
            a[s % 4] += 5;
            float r = 0;
            for (int i = 0; i < 4; ++i) r += float(i + 1) * a[i];
            return r;
        });
    expect_each("color c[2]; c[0] = 1; c[1] = color(s, 2, 3); r = comp(c[1], 0) + comp(c[0], 1);",
                [](int s) { return float(s + 1); });
}

TEST(LowerControl, IndicesOutsideAreClampedAndReported) {
    RunShader shader("surface t() { float a[3] = {1, 2, 3}; Ci = a[s]; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.set("s", {-1, 0, 2, 3, 1e30f, NAN});
    auto out = shader.run(6)["Ci.r"];
    EXPECT_EQ(out, (std::vector<float>{1, 1, 3, 3, 3, 1}));
    EXPECT_GT(shader.faults, 0);
}

TEST(LowerControl, EndlessLoopsAreFaults) {
    RunShader shader("surface t() { float x = 0; while (1 > 0) x += 1; Ci = x; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.run(1);
    EXPECT_GT(shader.faults, 0);
}

// Two hundred points with arrays of 2 to 201 elements, in memory that held 7 before.
constexpr const char* kRefilled =
    "surface t() { float a[], b[], c[]; float i, j; for (i = 0; i < 20; i += 1) for (j = 0; j < "
    "10; j += 1) push(a, 7); b = a; resize(a, 0); resize(a, s); push(a, s); c = a; "
    "Ci = color(a[s - 1] + a[s / 2], c[s], arraylength(c) + 1000 * (b[199] == 7) + 2000 * (a == c)"
    " + 4000 * (a == b)); }";

TEST(LowerControl, ArraysAreStoredWholeWhateverLoopsMayTurn) {
    LowerOptions options;
    options.loop_budget = 21;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader shader(kRefilled, options, {}, false, target.name);
        ASSERT_TRUE(shader.ok()) << shader.findings();
        std::vector<float> s(200);
        std::iota(s.begin(), s.end(), 1.0f);
        shader.set("s", s);
        auto out = shader.run(200);
        EXPECT_EQ(shader.faults, 0) << target.name;
        for (size_t k = 0; k < s.size(); ++k) {
            EXPECT_EQ(out["Ci.r"][k], 0) << target.name << " at s = " << s[k];
            EXPECT_EQ(out["Ci.g"][k], s[k]) << target.name;
            EXPECT_EQ(out["Ci.b"][k], s[k] + 1 + 1000 + 2000) << target.name << " at s = " << s[k];
        }
    }
}

TEST(LowerControl, TheBudgetOfLoopsIsAtLeastTheLongestArray) {
    LowerOptions options;
    options.loop_budget = 21;
    RunShader none("surface t() { float x = 0; while (1 > 0) x += 1; Ci = x; }", options);
    EXPECT_EQ(none.lowered.module.loop_budget, 21);
    none.run(1);
    EXPECT_GT(none.faults, 0);
    RunShader fixed("surface t() { float a[90]; a[s] = 1; Ci = a[t]; }", options);
    EXPECT_EQ(fixed.lowered.module.loop_budget, 90);
    RunShader reserved("surface t() { float a[]; reserve(a, 300); push(a, s); Ci = a[0]; }",
                       options);
    EXPECT_EQ(reserved.lowered.module.loop_budget, 300);
}

TEST(LowerControl, ALoopMayTakeItsWholeBudgetWithoutAFault) {
    LowerOptions options;
    options.loop_budget = 21;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader shader("surface t() { float a[]; resize(a, 300); a[s] = 4; Ci = a[299]; }",
                         options, {}, false, target.name);
        ASSERT_TRUE(shader.ok()) << shader.findings();
        EXPECT_EQ(shader.lowered.module.loop_budget, 300);
        shader.set("s", {299, 298});
        EXPECT_EQ(shader.run(2)["Ci.r"], (std::vector<float>{4, 0})) << target.name;
        EXPECT_EQ(shader.faults, 0) << target.name;
    }
}

TEST(LowerControl, RandomDiffersByCallLanePointAndTurn) {
    RunShader shader(
        "surface t() { float a = random(); float b = random(); float c = 0; float i; for (i = 0; i "
        "< 2; i += 1) c = c * 2 + random(); Ci = color(a, b, c); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_TRUE(shader.lowered.uses_rng);
    shader.set("rng", {std::bit_cast<float>(1), std::bit_cast<float>(2)});
    auto out = shader.run(2);
    EXPECT_NE(out["Ci.r"][0], out["Ci.g"][0]);
    EXPECT_NE(out["Ci.r"][0], out["Ci.r"][1]);
    EXPECT_GE(out["Ci.r"][0], 0);
    EXPECT_LT(out["Ci.r"][0], 1);
}

}  // namespace
}  // namespace kinora::rsl
