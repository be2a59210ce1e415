// tests/runtime/layer_test.cpp: stacks of surface shaders and transparent surfaces against
// compositing by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_text.h"

namespace kinora {
namespace {

struct Sheet {
    dvec3 color, opacity;  // colour already multiplied by the opacity
};

std::string shader(const char* name, const Sheet& s) {
    return fmt::format("surface {}() {{ Oi = color({}, {}, {}); Ci = color({}, {}, {}); }}\n", name,
                       s.opacity.x, s.opacity.y, s.opacity.z, s.color.x, s.color.y, s.color.z);
}

// Porter and Duff's over, a colour a component.
Sheet over(const Sheet& front, const Sheet& back) {
    return {front.color + (1.0 - front.opacity) * back.color,
            front.opacity + (1.0 - front.opacity) * back.opacity};
}

const Sheet kA{{0.3, 0.1, 0.0}, {0.5, 0.25, 0.75}};
const Sheet kB{{0.1, 0.4, 0.2}, {0.2, 0.6, 0.4}};
const Sheet kC{{0.0, 0.2, 0.5}, {0.9, 0.3, 0.5}};

void expect_pixel(const Rendering& r, const Sheet& want) {
    vec4 got = r.film.at(8, 8);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want.color[k], 2e-6) << "component " << k;
    EXPECT_NEAR(got.w, (want.opacity.x + want.opacity.y + want.opacity.z) / 3, 2e-6);
    EXPECT_EQ(r.findings(), "");
}

TEST(Layers, OfOnePassAreLaidOverEachOtherTheLastOnTop) {
    SceneText scene;
    scene.square("s", 1.5)
        .look("stack", shader("a", kA) + shader("b", kB) + shader("c", kC),
              "<shader stage=\"SURFACE\"><name>a</name></shader>"
              "<shader stage=\"SURFACE\"><name>b</name></shader>"
              "<shader stage=\"SURFACE\"><name>c</name></shader>")
        .place("s", "stack");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, over(kC, over(kB, kA)));
}

TEST(Layers, AnOpaqueLayerBelowMakesTheStackOpaque) {
    SceneText scene;
    Sheet ground{{0.2, 0.3, 0.4}, {1, 1, 1}};
    scene.square("s", 1.5)
        .look("stack", shader("a", ground) + shader("b", kB),
              "<shader stage=\"SURFACE\"><name>a</name></shader>"
              "<shader stage=\"SURFACE\"><name>b</name></shader>")
        .look("hidden", shader("h", kC))
        .place("s", "stack")
        .place("s", "hidden", "<translate>0 0 -1</translate>");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, over(kB, ground));
}

TEST(Transparency, SheetsCompositeInTheOrderOfDepthNotOfTheDocument) {
    const char* places[] = {"<translate>0 0 2</translate>", "<translate>0 0 1</translate>", ""};
    const int orders[][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    for (const auto& order : orders) {
        SceneText scene;
        scene.square("s", 1.5);
        scene.look("l0", shader("a", kA)).look("l1", shader("b", kB)).look("l2", shader("c", kC));
        for (int k : order) scene.place("s", fmt::format("l{}", k), places[k]);
        Rendering r(scene.text());
        r.frame();
        expect_pixel(r, over(kA, over(kB, kC)));
    }
}

// Pixels on the squares' diagonals, where a ray meets two triangles of one sheet, count once.
TEST(Transparency, SheetsAtOnePlaceAllCount) {
    const char* tilt = "<rotate>0 1 0 40</rotate><translate>0.1 0.3 0.7</translate>";
    for (const char* place : {"", "<translate>0 0 0.3</translate>", tilt}) {
        SCOPED_TRACE(place);
        SceneText scene;
        scene.square("s", 2.5).look("a", shader("a", kA)).look("b", shader("b", kB));
        scene.look("c", shader("c", kC)).look("ground", shader("g", {dvec3(1), dvec3(1)}));
        for (const char* look : {"a", "b", "c", "a", "b"}) scene.place("s", look, place);
        scene.place("s", "ground", std::string(place) + "<translate>0 0 -1</translate>");
        Rendering r(scene.text());
        r.frame();
        // In the order of the document.
        Sheet some = over(kA, over(kB, over(kC, over(kA, kB))));
        Sheet want = over(some, {dvec3(1), dvec3(1)});
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(r.film.at(x, y)[k], want.color[k], 2e-6) << x << "," << y << "\n"
                                                                         << r.findings();
    }
}

TEST(Transparency, SheetsAtOnePlaceAllDimLight) {
    SceneText scene;
    scene.square("s", 1.5)
        .look("floor", "surface f() { Oi = 1; Ci = diffuse(normalize(N)); }")
        .look("half", "surface b() { Oi = 0.5; Ci = 0; }")
        .place("s", "floor");
    for (int k = 0; k < 3; ++k) scene.place("s", "half", "<translate>0 0 11</translate>");
    scene.light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, {dvec3(0.125), dvec3(1)});
}

TEST(Transparency, OpacityIsConstantOrComputedAlike) {
    SceneText scene;
    scene.square("s", 1.5)
        .look("computed",
              "surface c() { Oi = mix(color(0.2, 0.6, 0.4), color(0.2, 0.6, 0.4), s);"
              "  Ci = color(0.1, 0.4, 0.2); }")
        .look("back", shader("a", kA))
        .place("s", "computed", "<translate>0 0 1</translate>")
        .place("s", "back");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, over(kB, kA));
}

TEST(Transparency, ShadowRaysAreDimmedByEverySheetOnTheirWay) {
    SceneText scene;
    scene.square("s", 1.5)
        .look("floor", "surface f() { Oi = 1; Ci = diffuse(normalize(N)); }")
        .look("a", shader("a", {dvec3(0), kA.opacity}))
        .look("b", "surface b() { Oi = color(s, 0.6, 0.4) + color(0.2 - s, 0, 0); Ci = 0; }")
        .place("s", "floor")
        // Above the eye at z = 10.
        .place("s", "a", "<translate>0 0 11</translate>")
        .place("s", "b", "<translate>0 0 12</translate>")
        .light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering r(scene.text());
    r.frame();
    expect_pixel(r, {(1.0 - kA.opacity) * (1.0 - kB.opacity), dvec3(1)});
}

// The same whether something of the scene is transparent or not.
TEST(Transparency, BlockedLightIsDarkHoweverStrong) {
    for (const char* aside : {"Oi = 1;", "Oi = 0.5;"}) {
        SceneText scene;
        scene.square("s", 1.5)
            .look("floor", "surface f() { Oi = 1; Ci = diffuse(normalize(N)) + color(0, 0.5, 0); }")
            .look("aside", std::string("surface a() { Ci = 0; ") + aside + " }")
            .place("s", "floor")
            .place("s", "floor", "<translate>0 0 11</translate>")
            .place("s", "aside", "<translate>500 0 0</translate>")
            .rsl_light("sun",
                       "light sun() { solar(vector \"world\" (0, 0, -1), 0) Cl = 1e30 * 1e30; }");
        Rendering r(scene.text());
        r.frame();
        expect_pixel(r, {dvec3(0, 0.5, 0), dvec3(1)});
    }
}

}  // namespace
}  // namespace kinora
