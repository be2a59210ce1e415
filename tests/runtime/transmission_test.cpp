// tests/runtime/transmission_test.cpp: what passes surfaces that are not opaque, towards lights and
// along traced rays, where Oi is beyond its range and where they are many.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "expect_colors.h"

namespace kinora {
namespace {

const char* kMirror = "surface floor() { Oi = 1; Ci = trace(P, vector \"world\" (0, 0, 1)); }";

// A floor; behind the camera, one above the other, `count` panes.
SceneText panes(const std::string& floor, const std::string& pane, int count) {
    SceneText scene = floor_scene(floor);
    scene.light("sun", kSun).look("pane", pane);
    for (int k = 0; k < count; ++k)
        scene.place("floor", "pane", fmt::format("<translate>0 0 {}</translate>", 20 + 0.01 * k));
    return scene;
}

// A sheet of a look behind all panes.
SceneText& add_last(SceneText& scene, const std::string& code) {
    return scene.look("last", code).place("floor", "last", "<translate>0 0 30</translate>");
}

struct Opacity {
    const char* given;
    dvec3 one, two;  // what one pane and two let through, as the camera has it
};
const Opacity kOpacities[] = {
    {"2", {0, 0, 0}, {0, 0, 0}},
    {"-1", {1, 1, 1}, {1, 1, 1}},
    {"color(0.5, 2, -1)", {0.5, 0, 1}, {0.25, 0, 1}},
};

TEST(Opacity, BeyondItsRangeIsClampedForLights) {
    for (const Opacity& row : kOpacities) {
        // Constant, and computed at each point.
        for (const char* form : {"Oi = {}", "Oi = {} * (1 + 1e-30 * s)"}) {
            SCOPED_TRACE(fmt::format(fmt::runtime(form), row.given));
            std::string pane =
                "surface pane() { " + fmt::format(fmt::runtime(form), row.given) + "; Ci = 0; }";
            for (int n : {1, 2})
                expect_colors(Rendering(panes(kMatte, pane, n).text()).frame(),
                              [&](dvec2) { return n == 1 ? row.one : row.two; });
        }
    }
}

TEST(Opacity, BeyondItsRangeIsClampedForTracedRays) {
    for (const Opacity& row : kOpacities) {
        SCOPED_TRACE(row.given);
        std::string pane = fmt::format("surface pane() {{ Oi = {}; Ci = 0.25; }}", row.given);
        SceneText scene = panes(kMirror, pane, 1);
        add_last(scene, "surface white() { Oi = 1; Ci = 1; }");
        expect_colors(Rendering(scene.text()).frame(), [&](dvec2) { return 0.25 + row.one; });
        scene = panes(
            "surface f() { Oi = 1; Ci = transmission(P, P + 29 * vector \"world\" (0, 0, 1)); }",
            pane, 2);
        expect_colors(Rendering(scene.text()).frame(), [&](dvec2) { return row.two; });
    }
}

TEST(Opacity, OfAnInteriorIsClampedForLights) {
    SceneText scene = floor_scene(kMatte);
    scene.light("sun", kSun).cube("box", 3);
    scene.look("box-look",
               "surface empty() { Oi = 0; Ci = 0; }\n"
               "volume v() { Oi = color(3, 1, -2); }",
               "<shader stage=\"SURFACE\"/><shader stage=\"VOLUME\"/>");
    scene.place("box", "box-look", "<translate>0 0 20</translate>");
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(0, 0, 1); });
}

TEST(Opacity, ThatIsNoNumberOnTheWayToALightIsReported) {
    Rendering r(panes(kMatte,
                      "surface pane() { float b = 1e30 * (1 + s); b = b * b; Oi = b - b; Ci = 0; }",
                      1)
                    .text());
    r.frame();
    EXPECT_EQ(r.stats.non_finite, 256u);
    EXPECT_EQ(r.count("SHADER_NON_FINITE"), 1) << r.findings();
}

const char* kClear = "surface pane() { Oi = 1e-30 * s; Ci = 0; }";
const char* kCard = "surface card() { Oi = 1 + 1e-30 * s; Ci = 0.5; }";

TEST(Layers, AsManyAsTheCameraSeesThroughLetLightPass) {
    for (int n : {16, 32, 33, 255, 256}) {
        SCOPED_TRACE(n);
        SceneText scene = panes(kMatte, kClear, n);
        Rendering clear(scene.text());
        expect_colors(clear.frame(), [](dvec2) { return dvec3(1); });
        EXPECT_EQ(clear.count("LAYER_LIMIT"), 0);
        if (n == 256) continue;
        Rendering blocked(add_last(scene, kCard).text());
        expect_colors(blocked.frame(), [](dvec2) { return dvec3(0); });
        EXPECT_EQ(blocked.count("LAYER_LIMIT"), 0);
    }
}

TEST(Layers, ThatAreTooManyLetNothingPassAndSaySoOnce) {
    for (const char* floor : {kMatte, kMirror}) {
        SceneText scene = panes(floor, kClear, 257);
        add_last(scene, "surface white() { Oi = 1 + 1e-30 * s; Ci = 1; }");
        Rendering r(scene.text());
        expect_colors(r.frame(), [](dvec2) { return dvec3(0); });
        EXPECT_EQ(r.count("LAYER_LIMIT"), 1) << r.findings();
        EXPECT_NE(r.findings().find("256 rays"), std::string::npos) << r.findings();
    }
}

TEST(Layers, OfTheCameraAreSeenThroughAndCountedWhereTheyAreTooMany) {
    for (int n : {32, 33, 255, 256}) {
        SCOPED_TRACE(n);
        SceneText scene = floor_scene("surface white() { Oi = 1; Ci = 1; }");
        scene.look("pane", kClear);
        for (int k = 0; k < n; ++k)
            scene.place("floor", "pane",
                        fmt::format("<translate>0 0 {}</translate>", 1 + 0.01 * k));
        Rendering r(scene.text());
        r.frame();
        bool seen = n < 256;
        EXPECT_EQ(r.film.at(3, 5), vec4(seen ? 1.0f : 0.0f));
        EXPECT_EQ(r.count("LAYER_LIMIT"), seen ? 0 : 1);
        EXPECT_EQ(r.findings().find("256 rays") == std::string::npos, seen) << r.findings();
    }
}

TEST(Layers, AreTracedAsDeepAsTheCameraSees) {
    for (int n : {16, 32, 255}) {
        SceneText scene = panes(kMirror, kClear, n);
        Rendering r(add_last(scene, kCard).text());
        expect_colors(r.frame(), [](dvec2) { return dvec3(0.5); });
        EXPECT_EQ(r.count("LAYER_LIMIT"), 0);
    }
}

}  // namespace
}  // namespace kinora
