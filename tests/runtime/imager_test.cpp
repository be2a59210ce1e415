// tests/runtime/imager_test.cpp: imagers and output parameters against arithmetic by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "jit/target.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/load/override_shader.h"
#include "scene_text.h"
#include "tests/folders.h"

namespace kinora {
namespace {

const char* kImager = "<shader stage=\"IMAGER\"/>";
// Half of the picture's width is covered by a sheet of opacity 0.5 and colour (1, 0.5, 0.25).
SceneText sheet_scene() {
    SceneText scene;
    return scene.square("s", 0.5)
        .look("sheet", "surface s() { Oi = 0.5; Ci = Oi * color(1, 0.5, 0.25); }")
        .place("s", "sheet", "<translate>-0.5 0 0</translate><scale>1 2 1</scale>");
}

void expect_pixel(const Rendering& r, int x, int y, vec4 want, double tolerance = 1e-6) {
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(r.film.at(x, y)[k], want[k], tolerance)
            << "pixel " << x << "," << y << " component " << k << "\n"
            << r.findings();
}

TEST(Imager, BackgroundIsPutBehindByAlpha) {
    SceneText scene = sheet_scene();
    scene.scene_effect(
        "back", fmt::format("#include \"{}/assets/shaders/background.sl\"", project_folder()),
        "<shader stage=\"IMAGER\"><bind symbol=\"background\">"
        "<color>0.2 0.4 0.8</color></bind></shader>");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, 4, 8, {0.6, 0.45, 0.525, 1});
    expect_pixel(r, 12, 8, {0.2, 0.4, 0.8, 1});
}

TEST(Imager, SeesThePlaceOfEachPixelInTheRaster) {
    SceneText scene;
    scene.scene_effect("place", "imager p() { Ci = color(xcomp(P), ycomp(P), zcomp(P)); }",
                       kImager);
    Rendering r(scene.text());
    r.frame(40, 33);
    for (int y : {0, 7, 32})
        for (int x : {0, 21, 39}) expect_pixel(r, x, y, {x + 0.5, y + 0.5, 0, 0});
}

TEST(Imager, OiAloneBecomesTheMeanCoverageAndAlphaWins) {
    SceneText scene = sheet_scene();
    scene.scene_effect("i", "imager i() { Oi = color(0.1, 0.2, 0.6); }", kImager);
    Rendering by_Oi(scene.text());
    by_Oi.frame();
    expect_pixel(by_Oi, 12, 8, {0, 0, 0, 0.3});
    scene = sheet_scene();
    scene.scene_effect("i", "imager i() { Oi = 1; alpha = alpha * 0.5; Ci = Oi * alpha; }",
                       kImager);
    Rendering by_alpha(scene.text());
    by_alpha.frame();
    expect_pixel(by_alpha, 4, 8, {0.25, 0.25, 0.25, 0.25});
}

TEST(Imager, ReadsCiOiAndAlphaOfThePixel) {
    SceneText scene = sheet_scene();
    scene.scene_effect("i", "imager i() { Ci = color(comp(Ci, 2), comp(Oi, 0), ncomps); }",
                       kImager);
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, 4, 8, {0.125, 0.5, 3, 0.5});
}

TEST(Imager, SeveralOfAPassRunOneAfterTheOther) {
    SceneText scene = sheet_scene();
    scene.scene_effect("two", "imager a() { Ci += 1; alpha = 0.25; } imager b() { Ci *= alpha; }",
                       "<shader stage=\"IMAGER\"><name>a</name></shader>"
                       "<shader stage=\"IMAGER\"><name>b</name></shader>");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, 4, 8, {0.375, 0.3125, 0.28125, 0.25});
}

TEST(Imager, TimeAndAnimatedParametersReachIt) {
    SceneText scene;
    scene.look("fade", "imager f(float k = 0;) { Ci = color(k, time, 0); }",
               "<shader stage=\"IMAGER\"><bind symbol=\"k\"><param ref=\"level\"/></bind></shader>",
               "<newparam sid=\"level\"><float>0</float></newparam>");
    scene.scene_extra = rsl_extra("<instance_effect url=\"#fade-fx\"/>");
    scene.animate("fade-fx/level", {0, 2}, {0, 1});
    Rendering r(scene.text());
    r.frame(0.5);
    expect_pixel(r, 3, 3, {0.25, 0.5, 0, 0});
}

TEST(Imager, OfTheCameraWinsOverTheScenes) {
    SceneText scene;
    scene.scene_effect("all", "imager a() { Ci = color(1, 0, 0); }", kImager);
    scene.look("own", "imager o() { Ci = color(0, 1, 0); }", kImager);
    scene.cameras.insert(scene.cameras.find("</camera>"),
                         rsl_extra("<instance_effect url=\"#own-fx\"/>"));
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, 3, 3, {0, 1, 0, 0});
}

TEST(Imager, WhatIsNotFiniteBecomesNought) {
    SceneText scene;
    scene.scene_effect("bad", "imager b() { Ci = color(1, 2, 1 / alpha); }", kImager);
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, 3, 3, {1, 2, 0, 0});
}

TEST(Imager, GivesTheSameBytesForAnyThreadsAndTargets) {
    SceneText scene = sheet_scene();
    scene.scene_effect("grain", "imager g() { Ci += 0.1 * random() + 0.1 * noise(P / 7); }",
                       kImager);
    std::string text = scene.text();
    Rendering first(text);
    first.frame(61, 47);
    EXPECT_FALSE(first.diagnostics.has_errors()) << first.findings();
    for (int threads : {1, 3}) {
        Threads scope(threads);
        Rendering again(text);
        EXPECT_TRUE(same_bytes(first.film, again.frame(61, 47).film)) << threads << " threads";
    }
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        SceneOptions options;
        options.target = &target;
        Rendering again(text, options);
        EXPECT_TRUE(same_bytes(first.film, again.frame(61, 47).film)) << target.name;
    }
}

const char* kOutputs =
    "surface s(output varying float dirt = 0; output varying color glow = 0;) {"
    "  dirt = s; glow = color(t, 2, 3); Oi = 1; Ci = 0.5; }";

TEST(Outputs, OfSurfacesReachPlanesOfTheirNames) {
    SceneText scene;
    scene.square("s", 0.5).look("l", kOutputs).place("s", "l");
    SceneOptions options;
    options.aovs = {"glow", "dirt", "nowhere"};
    Rendering r(scene.text(), options);
    EXPECT_EQ(r.count("AOV_UNKNOWN"), 1) << r.findings();
    r.frame();
    ASSERT_EQ(r.film.aovs.size(), 4u);
    const char* names[] = {"glow.R", "glow.G", "glow.B", "dirt"};
    for (size_t p = 0; p < 4; ++p) EXPECT_EQ(r.film.aovs[p].name, names[p]);
    dvec2 p = r.place(6, 9);
    size_t inside = 9 * 16 + 6, outside = 0;
    EXPECT_NEAR(r.film.aovs[0].values[inside], p.y + 0.5, 1e-5);
    EXPECT_NEAR(r.film.aovs[1].values[inside], 2, 1e-6);
    EXPECT_NEAR(r.film.aovs[2].values[inside], 3, 1e-6);
    EXPECT_NEAR(r.film.aovs[3].values[inside], p.x + 0.5, 1e-5);
    for (const auto& plane : r.film.aovs) EXPECT_EQ(plane.values[outside], 0.0f);
}

TEST(Outputs, OfArraysReachAPlaneAnElement) {
    SceneText scene;
    scene.square("s", 0.5)
        .look(
            "l",
            "surface s(output varying color lamps[2] = {1, 1}; output float w[3] = {4, 5, 6};)"
            "{ float k; for (k = 0; k < 2; k += 1) lamps[k] = color(s, k, 7); w[2] = t; Ci = 1; }")
        .place("s", "l");
    SceneOptions options;
    options.aovs = {"lamps", "w"};
    Rendering r(scene.text(), options);
    EXPECT_EQ(r.findings(), "");
    r.frame();
    const char* names[] = {"lamps.0.R", "lamps.0.G", "lamps.0.B", "lamps.1.R", "lamps.1.G",
                           "lamps.1.B", "w.0",       "w.1",       "w.2"};
    ASSERT_EQ(r.film.aovs.size(), 9u);
    dvec2 p = r.place(6, 9);
    const double values[] = {p.x + 0.5, 0, 7, p.x + 0.5, 1, 7, 4, 5, p.y + 0.5};
    for (size_t k = 0; k < 9; ++k) {
        EXPECT_EQ(r.film.aovs[k].name, names[k]);
        EXPECT_NEAR(r.film.aovs[k].values[9 * 16 + 6], values[k], 1e-5) << names[k];
    }
}

TEST(Outputs, OfTheNearestSurfaceAndOfShadersThatHaveThem) {
    SceneText scene;
    scene.square("s", 1.5)
        .look("l", kOutputs)
        .look("glass", "surface g(output varying float dirt = 0;) { dirt = 7; Oi = 0.5; Ci = 0; }")
        .look("plain", "surface p() { Oi = 1; Ci = 1; }")
        .look("gone", "surface g(output varying float dirt = 0;) { dirt = 9; Oi = 0; Ci = 0; }")
        .place("s", "l")
        .place("s", "gone", "<translate>0 0 3</translate>")  // is not there
        .place("s", "glass", "<translate>1.5 0 1</translate>")
        .place("s", "plain", "<translate>0 1.5 2</translate>");
    SceneOptions options;
    options.aovs = {"dirt"};
    Rendering r(scene.text(), options);
    r.frame();
    EXPECT_NEAR(r.film.aovs[0].values[12 * 16 + 12], 7, 1e-6);  // glass before the sheet
    EXPECT_EQ(r.film.aovs[0].values[2 * 16 + 4], 0.0f);         // the plain one
    EXPECT_GT(r.film.aovs[0].values[12 * 16 + 4], 0.1f);
}

TEST(Outputs, AreReadByImagersThatHaveParametersOfTheirNames) {
    SceneText scene;
    scene.square("s", 0.5).look("l", kOutputs).place("s", "l");
    scene.scene_effect("i",
                       "imager i(varying float dirt = 0; varying color glow = 0;) {"
                       " Ci = color(dirt, comp(glow, 0), comp(glow, 2)); }",
                       kImager);
    Rendering r(scene.text());
    r.frame();
    dvec2 p = r.place(6, 9);
    expect_pixel(r, 6, 9, {p.x + 0.5, p.y + 0.5, 3, 1}, 1e-5);
    expect_pixel(r, 1, 1, {0, 0, 0, 0});
    for (const auto& plane : r.film.aovs) EXPECT_FALSE(plane.in_file);
}

TEST(OverrideImager, TakesAStandardNameAFileOrNone) {
    SceneText scene;
    scene.scene_effect("i", "imager i() { Ci = 1; }", kImager);
    auto imagers = [&](const std::string& name, bool known) {
        std::string path = ::testing::TempDir() + "override_imager.dae";
        Diagnostics diagnostics;
        std::FILE* file = std::fopen(path.c_str(), "w");
        std::fputs(scene.text().c_str(), file);
        std::fclose(file);
        auto description = import_collada(path, {}, diagnostics);
        EXPECT_EQ(override_imager(*description, {name, {}}, diagnostics), known) << name;
        std::remove(path.c_str());
        const auto& list = description->picture.imagers;
        return list.empty() ? std::string("-") : list[0].shader->name;
    };
    EXPECT_EQ(imagers("none", true), "-");
    EXPECT_EQ(imagers("background", true), "background");
    EXPECT_EQ(imagers(project_folder() + "/assets/shaders/background.sl", true), "background");
    EXPECT_EQ(imagers("plastic", false), "i");
    EXPECT_EQ(imagers("nosuch", false), "i");
}

TEST(OverrideImager, TakesParametersByTheNameOfItsShader) {
    std::string path = ::testing::TempDir() + "override_imager_param.dae";
    Diagnostics diagnostics;
    std::FILE* file = std::fopen(path.c_str(), "w");
    std::fputs(sheet_scene().text().c_str(), file);
    std::fclose(file);
    auto description = import_collada(path, {}, diagnostics);
    std::remove(path.c_str());
    ASSERT_TRUE(override_imager(*description, {"background", {}}, diagnostics));
    EXPECT_TRUE(override_param(*description, "background.background", "0.25,0,1", diagnostics));
    EXPECT_FALSE(override_param(*description, "background.nosuch", "1", diagnostics));
    const std::vector<ParamSource>& params = description->picture.imagers.at(0).params;
    ASSERT_EQ(params.size(), 1u);
    const double want[] = {0.25, 0, 1};
    for (uint32_t k = 0; k < 3; ++k)
        EXPECT_EQ(description->values[params[0].value.offset + k], want[k]);
}

TEST(Imager, WhatIsNotFiniteIsCountedAndNamed) {
    SceneText scene = sheet_scene();
    scene.scene_effect("burn", "imager burn() { if (xcomp(P) < 8) Ci = (1e30 + xcomp(P)) * 1e30; }",
                       kImager);
    struct Row {
        raytrace::NanPolicy policy;
        vec4 want;
    };
    for (const Row& row : {Row{raytrace::NanPolicy::Zero, {0, 0, 0, 0.5}},
                           Row{raytrace::NanPolicy::Magenta, {1, 0, 1, 1}}}) {
        Rendering r(scene.text());
        r.settings.integrator.nan = row.policy;
        r.frame();
        expect_pixel(r, 4, 8, row.want);
        expect_pixel(r, 12, 8, {0, 0, 0, 0});
        EXPECT_EQ(r.stats.non_finite, 128u);
        ASSERT_EQ(r.count("SHADER_NON_FINITE"), 1) << r.findings();
        EXPECT_NE(r.findings().find("128 shading results"), std::string::npos) << r.findings();
        EXPECT_NE(r.findings().find("burn"), std::string::npos) << r.findings();
        // At its shader.
        LineColumn at = r.where(*r.find("SHADER_NON_FINITE"));
        size_t before = scene.text().find("imager burn");
        std::string until = scene.text().substr(0, before);
        EXPECT_EQ(int(at.line), 1 + int(std::count(until.begin(), until.end(), '\n')));
    }
}

}  // namespace
}  // namespace kinora
