// tests/rsl/lower_lights_test.cpp: light records read and written, layers, and what a kernel says
// of itself.
#include <gtest/gtest.h>

#include <cmath>

#include "rsl/reference/reference.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

TEST(LowerLights, MatteSumsItsLights) {
    RunShader shader(
        "surface m() { normal Nf = faceforward(normalize(N), I); Ci = ambient() + "
        "diffuse(Nf); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_TRUE(shader.lowered.uses_lights);
    shader.set3("N", 0, 0, 2);
    shader.set3("Ng", 0, 0, 1);
    shader.set3("I", 0, 0, -5);
    shader.lights = {{kLightAmbient, {}, {0.1f, 0.2f, 0.3f}},
                     {kLightIlluminate, {0, 3, 4}, {1, 1, 1}},
                     {kLightSolar, {0, 0, -1}, {9, 9, 9}}};
    auto out = shader.run(17);
    EXPECT_FLOAT_EQ(out["Ci.r"][0], 0.1f + 0.8f);
    EXPECT_FLOAT_EQ(out["Ci.b"][16], 0.3f + 0.8f);
    EXPECT_EQ(out["Oi.r"][0], 1);
}

TEST(LowerLights, NondiffuseAndNonspecularLightsAreLeftOut) {
    RunShader shader(
        "surface m() { Ci = color(comp(diffuse(N), 0), comp(specular(N, normalize(-I),"
        " 0.1), 0), comp(phong(N, -I, 10), 0)); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.set3("N", 0, 0, 1);
    shader.set3("I", 0, 0, -1);
    TestLight light;
    light.nondiffuse = 1;
    light.nonspecular = 0.25f;
    shader.lights = {light};
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 0);
    EXPECT_FLOAT_EQ(out["Ci.g"][0], 0.75f);
    EXPECT_FLOAT_EQ(out["Ci.b"][0], 0.75f);
}

// The light stands to the side: N . H is that of H half-way between (0.6, 0, 0.8) and N.
TEST(LowerLights, SpecularIsToThePowerEightOverRoughness) {
    RunShader shader(
        "surface m(float roughness = 0.1;) { vector V = normalize(-I);"
        " Ci = color(comp(specular(N, V, s), 0),"
        " comp(specularbrdf(normalize(vector (1.2, 0, 1.6)), N, V, s), 0), 0); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.set3("N", 0, 0, 1);
    shader.set3("I", 0, 0, -2);
    TestLight light;
    light.L[0] = 1.2f;
    light.L[2] = 1.6f;
    shader.lights = {light};
    std::vector<float> roughness = {0.02f, 0.1f, 0.5f, 1, 8};
    shader.set("s", roughness);
    auto out = shader.run(int(roughness.size()));
    double N_H = 1.8 / std::sqrt(0.6 * 0.6 + 1.8 * 1.8);
    for (size_t k = 0; k < roughness.size(); ++k) {
        double exponent = 8 / double(roughness[k]), want = std::pow(N_H, exponent);
        double tolerance = (1e-6 + 2e-7 * exponent) * want;  // N . H is a float
        EXPECT_NEAR(out["Ci.r"][k], want, tolerance) << roughness[k];
        EXPECT_NEAR(out["Ci.g"][k], want, tolerance) << roughness[k];
    }
}

// Ps is P: outside of illuminance where P now is, inside the position that is lit.
TEST(LowerLights, PsOfASurfaceIsP) {
    RunShader shader(
        "surface m() { float before = xcomp(Ps); P += 1; float moved = xcomp(Ps);"
        " point Q = P + 4; float lit = 0; illuminance(Q) lit += xcomp(Ps);"
        " Ci = color(before, moved, lit + 100 * xcomp(Ps)); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_EQ(shader.findings(), "");
    shader.set3("P", 2, 0, 0);
    shader.lights.resize(1);
    shader.services[Service::lights] = answer_zeros<Service::lights>;
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 2);
    EXPECT_EQ(out["Ci.g"][0], 3);
    EXPECT_EQ(out["Ci.b"][0], 7 + 300);
}

TEST(LowerLights, WhatIsNotRoughShinesInOneDirection) {
    RunShader shader(
        "surface m() { Ci = color(comp(specular(N, normalize(-I), 0), 0),"
        " comp(specularbrdf(vector (0, 0.6, 0.8), N, normalize(-I), 0), 0),"
        " comp(specularbrdf(vector (0, 0, 1), N, normalize(-I), 0), 0)); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.set3("N", 0, 0, 1);
    shader.set3("I", 0, 0, -1);
    TestLight light;
    light.L[1] = 0.6f;
    light.L[2] = 0.8f;
    shader.lights = {light};
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 0);
    EXPECT_EQ(out["Ci.g"][0], 0);
    EXPECT_EQ(out["Ci.b"][0], 1);
}

TEST(LowerLights, IlluminanceTestsConeLitAndCategory) {
    RunShader shader(
        "surface t() { color n = 0; illuminance(P, N, PI/2) n += color(1, 0, 0); "
        "illuminance(\"key\", P) n += color(0, 1, 0); illuminance(\"-key\", P, N, 4) n += Cl * "
        "color(0, 0, 1); Ci = n; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    ASSERT_EQ(shader.lowered.categories, std::vector<std::string>{"key"});
    shader.set3("N", 0, 0, 1);
    TestLight front, behind, key, dark, ambient;
    behind.L[2] = -1;
    behind.Cl[2] = 5;
    key.categories = 1;
    dark.lit = 0;
    ambient.kind = kLightAmbient;
    shader.lights = {front, behind, ambient, key, dark};
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 2);
    EXPECT_EQ(out["Ci.g"][0], 1);
    EXPECT_EQ(out["Ci.b"][0], 6);
}

TEST(LowerLights, IlluminanceCanBeLeftPerLane) {
    RunShader shader(
        "surface t() { float n = 0; illuminance(P) { if (n >= s) break; n += 1; if (n "
        "== 2) continue; n += 0.25; } Ci = n; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.lights.resize(4);
    shader.set("s", {0, 1, 2, 100});
    EXPECT_EQ(shader.run(4)["Ci.r"], (std::vector<float>{0, 1.25f, 2.5f, 5}));
}

TEST(LowerLights, LightsourceReadsMessages) {
    RunShader shader(
        "surface t() { float n = 7; float has = 0; illuminance(P) { has += "
        "lightsource(\"falloff\", n); } Ci = color(has, n, 0); }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    ASSERT_EQ(shader.lowered.light_messages, std::vector<std::string>{"falloff"});
    TestLight with, without;
    with.messages = {3};
    shader.lights = {without};
    EXPECT_EQ(shader.run()["Ci.g"][0], 7);
    shader.lights = {with};
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 1);
    EXPECT_EQ(out["Ci.g"][0], 3);
}

TEST(LowerLights, LightsWriteOneRecordAStatement) {
    RunShader light(
        "light l(float intensity = 8;) { illuminate(point \"shader\" (0, 0, 0), vector(0, 0, -1), "
        "PI/4) { Cl = intensity / (L . L); } solar(vector(0, 0, -2), 0) Cl = 0.5; }");
    ASSERT_TRUE(light.ok()) << light.findings();
    ASSERT_EQ(light.lowered.light_statements.size(), 2u);
    EXPECT_EQ(light.lowered.light_statements[0].kind, kLightIlluminate);
    EXPECT_EQ(light.lowered.light_statements[1].kind, kLightSolar);
    EXPECT_TRUE(light.lowered.light_statements[0].casts_shadow);
    light.set("Ps.z", std::vector<float>{-2, 2});
    auto out = light.run(2);
    EXPECT_EQ(out["light:0:Cl.r"], (std::vector<float>{2, 0}));
    EXPECT_EQ(out["light:0:L.z"][0], 2);
    EXPECT_EQ(std::bit_cast<int>(out["light:0:lit"][0]), 1);
    EXPECT_EQ(std::bit_cast<int>(out["light:0:lit"][1]), 0);
    EXPECT_EQ(out["light:1:L.z"][1], 1);
    EXPECT_EQ(out.count("light:0:Ol.r") + out.count("light:1:lit"), 0u);
    EXPECT_EQ(out["light:1:Cl.g"][1], 0.5f);
}

// What a renderer makes soft shadows of. One direction has no such output, which would cost
// records.
TEST(LowerLights, SolarTellsTheAngleOfItsCone) {
    RunShader light(
        "light l(float width = 0.5;) { solar(vector(0, 0, -1), 0) Cl = 1;"
        " solar(vector(0, 0, -1), width) Cl = 1; solar() Cl = 1;"
        " if (zcomp(Ps) > 0) solar(vector(0, 0, -1), 0.25) Cl = 1; }");
    ASSERT_TRUE(light.ok()) << light.findings();
    light.set("Ps.z", std::vector<float>{-2, 2});
    auto out = light.run(2);
    EXPECT_EQ(out["light:1:spread"], (std::vector<float>{0.5f, 0.5f}));
    EXPECT_EQ(out["light:3:spread"], (std::vector<float>{0, 0.25f}));
    EXPECT_EQ(out.count("light:0:spread") + out.count("light:2:spread"), 0u);
}

// The renderer gives L in the cone, or 0 for the axis; a block that does not read it takes none.
TEST(LowerLights, SolarTakesADirectionOfItsCone) {
    RunShader light("light l() { solar(vector(0, 0, -2), 0.5) Cl = color(L); }");
    ASSERT_TRUE(light.ok()) << light.findings();
    light.set("light:0:L.x", {0, 0.6f});
    light.set("light:0:L.z", {0, -0.8f});
    auto out = light.run(2);
    EXPECT_EQ(out["light:0:Cl.r"], (std::vector<float>{0, 0.6f}));
    EXPECT_EQ(out["light:0:Cl.b"], (std::vector<float>{-1, -0.8f}));
    EXPECT_EQ(out["light:0:L.z"], (std::vector<float>{1, 1}));  // the axis, from Ps
    RunShader sets("light l() { solar(vector(0, 0, -2), 0.5) { L = vector(2, 0, 0); Cl = 1; } }");
    EXPECT_EQ(sets.run(1)["light:0:L.x"], std::vector<float>{-2});
    RunShader plain("light l() { solar(vector(0, 0, -2), 0.5) Cl = 1; }");
    for (const jit::InputInfo& input : plain.kernels.point->inputs)
        EXPECT_FALSE(input.name.starts_with("light:")) << input.name;
}

// Behind its only statement, and only where that lights.
TEST(LowerLights, WhatIsAssignedBehindTheStatementCounts) {
    RunShader light(
        "light a() { illuminate(point \"current\" (0, 0, 0), vector(0, 0, 1), 0.5) { Cl = 3; }"
        " Cl *= 0.5; }");
    ASSERT_TRUE(light.ok()) << light.findings();
    light.set("Ps.z", {1, -1});
    auto out = light.run(2);
    EXPECT_EQ(out["light:0:Cl.r"], (std::vector<float>{1.5f, 0}));
}

TEST(LowerLights, AmbientLightsHaveNoStatement) {
    RunShader light("light a(color lightcolor = color(1, 2, 3);) { Cl = 2 * lightcolor; }");
    ASSERT_TRUE(light.ok()) << light.findings();
    ASSERT_EQ(light.lowered.light_statements.size(), 1u);
    EXPECT_EQ(light.lowered.light_statements[0].kind, kLightAmbient);
    EXPECT_EQ(light.value("light:0:Cl.b"), 6);
}

TEST(LowerLights, ShadowCallsSwitchAutomaticShadowsOff) {
    RunShader light("light l() { illuminate(P) Cl = 1 - float shadow(\"map\", Ps); }");
    ASSERT_TRUE(light.ok()) << light.findings();
    EXPECT_FALSE(light.lowered.light_statements[0].casts_shadow);
}

TEST(LowerLayers, SurfacesCompositeTopFirst) {
    RunShader stack(
        "surface below() { Ci = color(1, 1, 1); Oi = 1; } surface above() { Oi = 0.25; "
        "Ci = Oi * color(0, 1, 0); }",
        {}, {}, true);
    ASSERT_TRUE(stack.ok()) << stack.findings();
    auto out = stack.run();
    EXPECT_FLOAT_EQ(out["Ci.r"][0], 0.75f);
    EXPECT_FLOAT_EQ(out["Ci.g"][0], 1);
    EXPECT_FLOAT_EQ(out["Oi.b"][0], 1);
}

TEST(LowerLayers, DisplacementsBendTheNormalAndRestoreP) {
    RunShader stack(
        "displacement d(output float amount = 2;) { P += amount * N; N = normal(1, 0, 0); } "
        "surface t() { float a = 0; float has = displacement(\"amount\", a); Ci = color(zcomp(P), "
        "xcomp(N), a * has); }",
        {}, {}, true);
    ASSERT_TRUE(stack.ok()) << stack.findings();
    stack.set3("N", 0, 0, 1);
    stack.set3("P", 0, 0, 5);
    auto out = stack.run();
    EXPECT_EQ(out["Ci.r"][0], 5);
    EXPECT_EQ(out["Ci.g"][0], 1);
    EXPECT_EQ(out["Ci.b"][0], 2);
}

TEST(LowerKernel, JudgesOpacity) {
    auto opacity = [](const std::string& body, std::vector<ParamBinding> params = {}) {
        RunShader shader("surface t(float a = 0.5; string m = \"\";) { " + body + " }", {}, params);
        EXPECT_TRUE(shader.ok()) << shader.findings();
        return shader.lowered.opacity;
    };
    using Opacity = LoweredShader::Opacity;
    EXPECT_EQ(opacity("Ci = 1;"), Opacity::Opaque);
    EXPECT_EQ(opacity("Oi = Os; Ci = Oi * Cs;"), Opacity::Opaque);
    EXPECT_EQ(opacity("Oi = a;"), Opacity::Constant);
    EXPECT_EQ(opacity("Oi = a;", {{"a", ParamBinding::Kind::Frame, {}, {}}}), Opacity::Constant);
    EXPECT_EQ(opacity("Oi = s;"), Opacity::Computed);
    EXPECT_EQ(opacity("if (m != \"\") Oi = float texture(m);"), Opacity::Opaque);
}

TEST(LowerKernel, BindsParameters) {
    using Kind = ParamBinding::Kind;
    RunShader shader(
        "surface t(float a = 1; color c = 0; varying float w = s; float list[2] = {1, 2};) { Ci = "
        "color(a, comp(c, 1), w + list[1]); }",
        {},
        {{"a", Kind::Constant, {4}, {}}, {"c", Kind::Frame, {}, {}}, {"w", Kind::Varying, {}, {}}});
    ASSERT_TRUE(shader.ok()) << shader.findings();
    shader.set("param:0:c.g", 3);
    shader.set("param:0:w", 5);
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 4);
    EXPECT_EQ(out["Ci.g"][0], 3);
    EXPECT_EQ(out["Ci.b"][0], 7);
}

TEST(LowerKernel, FindsTheParametersThatShapeIt) {
    RunShader shader(
        "surface t(float n = 3; float k = 1; string map = \"\"; float edge = 0.5;) { float i; "
        "float "
        "limit = 2 * n; float x = 0; for (i = 0; i < limit; i += 1) x += k; if (s > edge) x = 0; "
        "if (map != \"\") x = 1; Ci = x; }");
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_EQ(shape_parameters(*shader.shaders[0]), (std::vector<bool>{true, false, true, false}));
}

TEST(LowerKernel, WritesAovs) {
    LowerOptions options;
    options.aovs = {"shine", "none"};
    RunShader shader(
        "surface t(output varying color shine = 0;) { shine = color(1, 2, 3); Ci = 0; }", options);
    ASSERT_TRUE(shader.ok()) << shader.findings();
    EXPECT_EQ(shader.value("aov:shine.g"), 2);
}

ParamBinding link(const char* name, const char* variable) {
    ParamBinding binding;
    binding.name = name;
    binding.kind = ParamBinding::Kind::Layer;
    binding.below = 1;
    binding.variable = variable;
    return binding;
}

// At s = 1/4 and t = 1/2.
TEST(LowerLayers, TheReferenceFollowsLinksAsKernelsDo) {
    const std::vector<ParamBinding> params = {link("amount", "depth"), link("shade", "tone"),
                                              link("spread", "depth"), link("third", "list"),
                                              link("Cs", "tone")};
    RunShader run(
        "surface grain(output varying float depth = 0; color tone = 0; float list[3] = {0, 0, 0};)"
        "{ depth = 2 * s; tone = color(s, t, 1); list[0] = 7; Ci = 0; Oi = 0; }"
        "surface varnish(float amount = 9; color shade = 9, spread = 9; float third[3] = {9, 9, "
        "9};)"
        "{ Ci = color(amount + comp(shade, 1), comp(spread, 2) + third[0], comp(Cs, 2)); Oi = 1; }",
        {}, params, true);
    ASSERT_TRUE(run.ok()) << run.findings();
    run.set("s", .25f), run.set("t", .5f);
    ReferenceInputs inputs;
    inputs.values = {{"s", .25}, {"t", .5}};
    std::vector<Layer> layers;
    for (const auto& shader : run.shaders) layers.push_back({shader.get(), params});
    const ReferenceResult reference = run_reference<double>(layers, inputs);
    auto kernel = run.run();
    const std::pair<const char*, double> wanted[] = {{"Ci.r", 1}, {"Ci.g", 7.5}, {"Ci.b", 1}};
    for (const auto& [name, value] : wanted) {
        EXPECT_EQ(kernel[name][0], float(value)) << name;
        EXPECT_EQ(reference.values.at(name), value) << name;
    }
}

}  // namespace
}  // namespace kinora::rsl
