// tests/rsl/lenient_test.cpp: calls that other renderers let pass are warned of, and mean what
// their writers evidently meant.
#include <gtest/gtest.h>

#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

float red(RunShader& run) {
    return run.ok() ? run.value("Ci.r") : -1;
}
bool finds(const RunShader& run, const char* code) {
    return run.findings().find(code) != std::string::npos;
}

TEST(Lenient, FormatsWithTooFewAndTooManyValues) {
    RunShader few("surface t() { Ci = format(\"a %f b %f\", 3) == \"a 3 b %f\" ? 1 : 0; }");
    EXPECT_EQ(red(few), 1);
    EXPECT_TRUE(finds(few, "RSL_FORMAT_ARGUMENTS")) << few.findings();
    RunShader many("surface t() { Ci = format(\"<%d>\", 3, 4, N) == \"<3>\" ? 1 : 0; }");
    EXPECT_EQ(red(many), 1);
    EXPECT_TRUE(finds(many, "RSL_FORMAT_ARGUMENTS")) << many.findings();
    RunShader print("surface t() { printf(\"%f %f\\n\", s); printf(\"\\n\", s); Ci = 1; }");
    EXPECT_TRUE(print.ok()) << print.findings();
}

TEST(Lenient, UnknownResultsOfGatherAreLeftAlone) {
    RunShader run(
        "surface t() { color c = 5; float x = 2; gather(\"\", P, N, 0, 1, \"primitive:Cs\", c, "
        "\"surface:Ci\", x) { } Ci = color(x); }");
    EXPECT_TRUE(run.lowered.gathers.size() == 1 && run.lowered.gathers[0].empty());
    EXPECT_TRUE(finds(run, "primitive:Cs")) << run.findings();
    EXPECT_TRUE(finds(run, "surface:Ci")) << run.findings();
}

TEST(Lenient, AFilterThatIsNotKnownIsTheBox) {
    for (const char* name : {"box", "triangle", "gaussian", "catmull-rom", "sinc", "Box"}) {
        RunShader run(std::string("surface t() { Ci = filterstep(0.75, 0, 1, \"filter\", \"") +
                      name + "\"); }");
        bool known = std::string("sinc Box").find(name) == std::string::npos;
        EXPECT_EQ(finds(run, "RSL_FILTER_UNKNOWN"), !known) << name << run.findings();
        EXPECT_EQ(run.diagnostics.findings().size(), known ? 0u : 1u) << run.findings();
        bool box = !known || std::string(name) == "box";
        EXPECT_EQ(red(run) == 0.25f, box) << name;
    }
    RunShader varies(
        "surface t() { string f = s > 0 ? \"box\" : \"triangle\"; "
        "Ci = filterstep(0.75, 0, 1, \"filter\", f); }");
    EXPECT_TRUE(finds(varies, "RSL_FILTER_UNKNOWN")) << varies.findings();
}

// A function's body stands wherever it is called, and a source is lowered more than once.
TEST(Lenient, WhatLoweringFindsIsSaidOnce) {
    RunShader run(
        "float f(float x) { return filterstep(x, 0, 1, \"filter\", \"none\"); } "
        "color g(point p) { return trace(p, p, \"none\", 3); } "
        "surface t() { printf(\"%f\", f(s) + f(t), 1); Ci = g(P) * f(u) + g(N); }");
    ASSERT_TRUE(run.ok()) << run.findings();
    EXPECT_EQ(run.diagnostics.findings().size(), 3u) << run.findings();
    Layer layer{run.shaders[0].get(), {}};
    lower({&layer, 1}, {}, run.diagnostics);
    EXPECT_EQ(run.diagnostics.findings().size(), 3u) << run.findings();
    Diagnostics other;
    lower({&layer, 1}, {}, other);
    EXPECT_EQ(other.findings().size(), 3u);
}

TEST(Lenient, AnErrorOfLoweringCausesNoOthers) {
    RunShader knots(
        "surface t() { float a[3] = {1, 2, 3}; color b[4] = {0, 1, 0.5, 1}; float c[4] = {1, 2, "
        "3, 4}; Ci = spline(s, a) + spline(s, b) + spline(\"bspline\", s, c); }");
    EXPECT_EQ(knots.diagnostics.findings().size(), 1u) << knots.findings();
    EXPECT_TRUE(finds(knots, "RSL_SPLINE_KNOTS")) << knots.findings();
    RunShader twice(
        "color f(float x) { return ctransform(\"no\", color x) + spline(\"no\", x, 1, 2, 3, 4); } "
        "surface t() { Ci = f(s) + f(t); float a[9] = {1, 2}; float b[4] = {1, 2, 3, 4}; "
        "Oi = a[3] + spline(t, b); }");
    EXPECT_EQ(twice.diagnostics.findings().size(), 2u) << twice.findings();
}

TEST(Lenient, OptionalParametersThatACalleeDoesNotKnowAreNamed) {
    struct Case {
        const char *call, *unknown;  // "" where all are known
    };
    const Case kCases[] = {
        {"trace(P, N, \"maxdist\", 1, \"hitmode\", \"shader\")", ""},
        {"trace(P, N, \"falloff\", 1)", "'falloff' of trace"},
        {"occlusion(P, N, 4, \"falloff\", 1)", ""},
        {"occlusion(P, N, 4, \"distribution\", \"cosine\")", ""},
        {"occlusion(P, N, 4, \"distant\", \"cosine\")", "'distant' of occlusion"},
        {"texture3d(\"a.ptc\", P, N, \"fastlookup\", 1)", "'fastlookup' of texture3d"},
        {"indirectdiffuse(P, N, 4, \"samples\", 2)", "'samples' of indirectdiffuse"},
        {"transmission(P, P + N, \"sample\", 2)", "'sample' of transmission"},
        {"photonmap(\"a.ptc\", P, N, \"estimator\", 9)", ""},
        {"texture(\"a\", s, t, \"blurr\", 1)", "'blurr' of texture"},
        {"texture(\"a\", \"swidth\", 1, \"lerp\", 1, \"samples\", 4, \"filter\", \"box\")", ""},
        {"environment(\"a\", N, \"blurr\", 1)", "'blurr' of environment"},
        {"environment(\"a\", N, \"swidth\", 1, \"twidth\", 2, \"filter\", \"box\")", ""},
        {"environment(\"raytrace\", N, \"maxdist\", 1, \"bla\", 2)", "'bla' of environment"},
        {"shadow(\"a\", P, \"blr\", 1, \"bias\", 0.1, \"swidth\", 2)", "'blr' of shadow"},
        {"color(bump(\"a\", N, dPdu, dPdv, \"hight\", 1))", "'hight' of bump"},
        {"filterstep(0, s, \"wide\", 1)", "'wide' of filterstep"},
        {"photonmap(\"a.ptc\", P, N, \"radius\", 9)", "'radius' of photonmap"},
    };
    for (const Case& c : kCases) {
        RunShader run(std::string("surface t() { Ci = ") + c.call + "; }");
        EXPECT_TRUE(run.ok()) << c.call << "\n" << run.findings();
        EXPECT_EQ(finds(run, "RSL_PAIR_UNKNOWN"), *c.unknown != 0) << run.findings();
        EXPECT_TRUE(finds(run, c.unknown)) << c.call << "\n" << run.findings();
    }
    RunShader gather(
        "surface t() { gather(\"\", P, N, 0, 1, \"distribution\", \"cosine\", \"far\", 1) { } }");
    EXPECT_TRUE(finds(gather, "'far' of gather")) << gather.findings();
    EXPECT_FALSE(finds(gather, "'distribution' of")) << gather.findings();
}

TEST(Lenient, OptionalParametersWithoutEffectAreNamed) {
    struct Case {
        const char *call, *idle;  // "" where all do what they say
    };
    const Case kCases[] = {
        {"trace(P, N, \"hitsides\", \"front\")", "'hitsides' of trace has no effect"},
        {"trace(P, N, \"hitsides\", \"both\", \"hitmode\", \"default\")", ""},
        {"trace(P, N, \"hitmode\", \"primitive\")", "'hitmode' of trace has no effect"},
        {"occlusion(P, N, 4, \"hitsides\", \"back\")", "'hitsides' of occlusion has no effect"},
        {"occlusion(P, N, 4, \"distribution\", \"uniform\")", "'distribution' of occlusion"},
        {"indirectdiffuse(P, N, 4, \"subset\", \"a\")", "'subset' of indirectdiffuse"},
        {"texture3d(\"a.ptc\", P, N, \"filterradius\", 1)", "'filterradius' of texture3d"},
        {"texture3d(\"a.ptc\", P, N, \"coordsystem\", \"object\")", ""},
    };
    for (const Case& c : kCases) {
        RunShader run(std::string("surface t() { Ci = ") + c.call + "; }");
        EXPECT_TRUE(run.ok()) << c.call << "\n" << run.findings();
        EXPECT_EQ(finds(run, "RSL_PAIR_IDLE"), *c.idle != 0) << c.call << run.findings();
        EXPECT_TRUE(finds(run, c.idle)) << c.call << "\n" << run.findings();
    }
    RunShader gather("surface t() { gather(\"\", P, N, 0, 1, \"hitsides\", \"front\") { } }");
    EXPECT_TRUE(finds(gather, "'hitsides' of gather has no effect")) << gather.findings();
}

TEST(Lenient, ShadowRaysOfBmrtAskForOpacityAlone) {
    const char* source = "surface t() { if (isshadowray() == 1) Oi = 0.25; else Oi = 1; Ci = Oi; }";
    RunShader seen(source);
    EXPECT_EQ(red(seen), 1);
    LowerOptions opacity;
    opacity.want_Ci = false;
    RunShader shadow(source, opacity);
    ASSERT_TRUE(shadow.ok()) << shadow.findings();
    EXPECT_EQ(shadow.value("Oi.r"), 0.25f);
}

}  // namespace
}  // namespace kinora::rsl
