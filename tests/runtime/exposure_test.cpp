// tests/runtime/exposure_test.cpp: how bright pictures are made, against arithmetic by hand.
#include "runtime/picture/frame/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "expect_colors.h"

namespace kinora {
namespace {

double auto_stops(Rendering& r) {
    return auto_exposure(*r.scene, r.scene->options, *r.pose, r.settings, r.diagnostics);
}

TEST(Exposure, MultipliesColorsAndLeavesCoverageAndBackground) {
    SceneText scene;
    scene.square("pane", 0.5)
        .look("glass", "surface s() { Oi = 0.5; Ci = color(0.1, 0.2, 0.4); }")
        .place("pane", "glass");
    Rendering r(scene.text());
    r.settings.gain = 4;
    r.frame();
    EXPECT_NEAR(r.color(8, 8).z, 1.6, 1e-6);
    EXPECT_NEAR(r.film.at(8, 8).w, 0.5, 1e-6);
    EXPECT_EQ(r.film.at(0, 0).w, 0);
    r.settings.integrator.background = vec3(0.25, 0.5, 1);
    r.frame();
    EXPECT_NEAR(r.color(0, 0).x, 0.25, 1e-6);
    EXPECT_NEAR(r.color(8, 8).x, 0.4 + 0.5 * 0.25, 1e-6);
    EXPECT_NEAR(r.color(8, 8).z, 1.6 + 0.5 * 1, 1e-6);
}

TEST(Exposure, ComesBeforeTheImager) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = 0.25; }");
    scene.scene_effect("half", "imager half() { Ci = step(0.4, comp(Ci, 0)); }",
                       "<shader stage=\"IMAGER\"/>");
    Rendering r(scene.text());
    EXPECT_EQ(r.frame().color(8, 8).x, 0) << r.findings();
    r.settings.gain = 2;
    EXPECT_EQ(r.frame().color(8, 8).x, 1);
}

TEST(AutoExposure, BringsAnEvenPictureToThreeFifths) {
    for (double level : {0.15, 0.6, 4.8}) {
        Rendering r(
            floor_scene("surface s() { Oi = 1; Ci = " + std::to_string(level) + "; }").text());
        EXPECT_NEAR(auto_stops(r), std::log2(0.6 / level), 1e-12) << level;
    }
}

// 13 pictures at 0, 1, ..., 12: ten of them and a bit are below four fifths.
TEST(AutoExposure, IsOneForTheWholeRange) {
    SceneOptions options;
    options.end_time = 12;
    Rendering r(floor_scene("surface s() { Oi = 1; Ci = 0.1 + 0.1 * time; }").text(), options);
    double want = std::round(10 * std::log2(0.6 / 1.1)) / 10;
    EXPECT_NEAR(auto_stops(r), want, 1e-12);
    r.frame(7.0);
    EXPECT_NEAR(auto_stops(r), want, 1e-12);
}

TEST(AutoExposure, LooksAtWhatIsCoveredAndLit) {
    // A bright half, a black half, an empty surrounding of whatever color.
    SceneText scene;
    scene.square("pane", 0.5)
        .look("half", "surface s() { Oi = 0.5; Ci = Oi * step(0.5, s) * 0.3; }")
        .place("pane", "half");
    Rendering r(scene.text());
    r.settings.integrator.background = vec3(9);
    EXPECT_NEAR(auto_stops(r), 1, 1e-12);
    Rendering black(floor_scene("surface s() { Oi = 1; Ci = 0; }").text());
    EXPECT_EQ(auto_stops(black), 0);
}

TEST(AutoExposure, PrintsNothingAndLeavesThePictureAsItWas) {
    SceneText scene =
        floor_scene("surface s() { Oi = 1; Ci = 0.5 + 0.1 * time; printf(\"seen %f\\n\", time); }");
    SceneOptions options;
    options.end_time = 2;
    Rendering plain(scene.text(), options), measured(scene.text(), options);
    testing::internal::CaptureStdout();
    auto_stops(measured);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    testing::internal::CaptureStdout();
    EXPECT_TRUE(same_bytes(plain.frame(0.5).film, measured.frame(0.5).film));
    EXPECT_NE(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace kinora
