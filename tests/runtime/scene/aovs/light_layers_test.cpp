// tests/runtime/scene/aovs/light_layers_test.cpp: AOVs of some of the light, against numbers worked
// out by hand and sums.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

struct Wanted {
    std::vector<std::string> aovs = {}, groups = {};
    int samples = 1;
};

std::unique_ptr<Rendering> taken(const SceneText& scene, const Wanted& wanted) {
    SceneOptions options;
    options.aovs = wanted.aovs;
    options.light_groups = wanted.groups;
    auto r = std::make_unique<Rendering>(scene.text(), options);
    r->settings.integrator.samples_per_pixel = wanted.samples;
    r->frame();
    return r;
}

vec3 layer(const Rendering& r, const std::string& name, int x, int y) {
    vec3 color(-1.0f);
    for (int c = 0; c < 3; ++c) {
        auto plane = std::ranges::find(r.film.aovs, fmt::format("{}.{}", name, "RGB"[c]),
                                       &raytrace::AovPlane::name);
        EXPECT_NE(plane, r.film.aovs.end()) << name;
        if (plane != r.film.aovs.end()) color[c] = plane->values[size_t(y) * 16 + size_t(x)];
    }
    return color;
}

void expect_color(vec3 found, vec3 want, const std::string& what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], want[c], 2e-6) << what << ' ' << c;
}

// The layers sum to the picture within 1e-5 of its largest value.
void expect_sum(const Rendering& r, const std::vector<std::string>& layers) {
    float largest = 0;
    for (const vec4& pixel : r.film.rgba) largest = std::max({largest, pixel.x, pixel.y, pixel.z});
    EXPECT_GT(largest, 0);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            vec3 sum(0.0f);
            for (const std::string& name : layers) sum += layer(r, name, x, y);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sum[c], r.color(x, y)[c], 1e-5f * largest) << x << ' ' << y;
        }
}

const char* const kTurn = "<rotate>0 1 0 60</rotate>";

// A sheet that glows, a lamp straight before it, one at 60 degrees and one from all sides.
TEST(LightLayers, HaveThePartOfEachLight) {
    SceneText scene;
    scene.square("s", 1)
        .look("l",
              "surface l() { Ci = color(.5, .25, 1) * (ambient() + diffuse(normalize(N))) + "
              "color(0, .125, 0); }")
        .place("s", "l")
        .light("ahead", kSun)
        .light("aside", "<directional><color>0 2 0</color></directional>", kTurn)
        .light("around", "<ambient><color>1 1 1</color></ambient>");
    const auto taken_frame = taken(
        scene, {{"direct", "indirect", "emission", "light_*", "light_rest"}, {"both=ahead,asi*"}});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    expect_color(layer(r, "emission", 8, 8), {0, .125, 0}, "emission");
    expect_color(layer(r, "indirect", 8, 8), {0, 0, 0}, "indirect");
    expect_color(layer(r, "light_ahead-node", 8, 8), {.5, .25, 1}, "ahead");
    expect_color(layer(r, "light_aside-node", 8, 8), {0, .25, 0}, "aside");
    expect_color(layer(r, "light_around-node", 8, 8), {.5, .25, 1}, "around");
    expect_color(layer(r, "both", 8, 8), {.5, .5, 1}, "both");
    expect_color(layer(r, "direct", 8, 8), {1, .75, 2}, "direct");
    expect_sum(r, {"emission", "direct", "indirect"});
}

// The front sheet sees the back one in a mirror and lets half of it through.
SceneText glass_and_mirror() {
    SceneText scene;
    scene.square("s", 1)
        .look(
            "mirror",
            "surface m() { Oi = .5; vector R = vector \"camera\" (0, 0, 1);"
            " Ci = .25 * trace(P, R) + .125 * diffuse(normalize(N)) * (1 - occlusion(P, N, 16)); }")
        .look("wall", "surface w() { Ci = color(1, .5, 0) * diffuse(normalize(N)) + .0625; }")
        .place("s", "wall", "<translate>0 0 -1</translate>")
        .place("s", "mirror", "<translate>-.5 0 1</translate>")
        .light("sun", kSun);
    return scene;
}

TEST(LightLayers, OfWhatIsBehindAndReflectedSumToThePicture) {
    const auto taken_frame =
        taken(glass_and_mirror(),
              {{"direct", "indirect", "emission", "light_sun-node", "light_rest"}, {}, 4});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    expect_sum(r, {"direct", "indirect", "emission"});
    expect_sum(r, {"light_sun-node", "indirect", "emission"});
    // Behind the mirror: half of the wall's, which the mirror shades; its own 1/8.
    EXPECT_GT(layer(r, "indirect", 4, 8).x, 0.01f);
    expect_color(layer(r, "emission", 4, 8), vec3(.03125f), "emission through glass");
    expect_color(layer(r, "emission", 14, 8), vec3(.0625f), "emission");
    expect_color(layer(r, "light_rest", 14, 8), vec3(0), "rest");
}

// A fog that glows and is lit; lights asked along the way and by gather.
TEST(LightLayers, SumToThePictureInFogAndForGatherAndForLightsElsewhere) {
    SceneText scene = glass_and_mirror();
    scene
        .scene_effect("fog",
                      "volume fog() { float t = exp(-length(I) / 16); color lit = 0;"
                      " illuminance(P) { lit += Cl; }"
                      " Ci = t * Ci + (1 - t) * (color(0, 0, .25) + .25 * lit);"
                      " Oi = t * Oi + (1 - t); }",
                      "<shader stage=\"VOLUME\"/>")
        .look("gathers",
              "surface g() { color c = 0, hit = 0; normal Nn = normalize(N);"
              " gather(\"illuminance\", P, Nn, 1, 8, \"surface:Ci\", hit) { c += hit; } else { c "
              "+= .5; }"
              " color far = 0; point Q = P + .25 * Nn; illuminance(Q) { far += Cl; }"
              " Ci = c / 8 + .25 * far; }")
        .place("s", "gathers", "<translate>1.5 0 2</translate>")
        .light("lamp", "<point><color>2 1 0</color></point>", "<translate>0 0 4</translate>");
    const auto taken_frame =
        taken(scene, {{"direct", "indirect", "emission", "light_*"}, {"two=sun,lamp"}, 4});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.findings(), "");
    expect_sum(r, {"direct", "indirect", "emission"});
    expect_sum(r, {"two", "indirect", "emission"});
    expect_sum(r, {"light_sun-node", "light_lamp-node", "indirect", "emission"});
    EXPECT_GT(layer(r, "emission", 8, 8).z, 0.05f);
}

// A wall before the lamp of 3/4 of the light.
TEST(LightLayers, OfShadowsAreShares) {
    SceneText scene;
    scene.square("s", 1)
        .square("small", 0.5)
        .look("m", kMatte)
        .place("s", "m")
        .place("small", "m", "<translate>-2.5 0 1.2990381</translate>", "wall")
        .light("ahead", kSun)
        .light("aside", "<directional><color>6 6 6</color></directional>",
               "<rotate>0 1 0 -60</rotate>");
    const auto taken_frame = taken(scene, {{"shadow", "direct"}});
    const Rendering& r = *taken_frame;
    auto shadow = [&](int x) {
        auto plane = std::ranges::find(r.film.aovs, "shadow", &raytrace::AovPlane::name);
        return plane->values[size_t(8) * 16 + size_t(x)];
    };
    // Light from (-sin 60, 0, cos 60): the shadow is 1.299 tan 60 from the wall.
    size_t dark = 0;
    for (int x = 0; x < 16; ++x) {
        const double from = r.place(x, 8).x - 1.2990381 * std::tan(radians(60.0));
        const bool hidden = std::abs(from + 2.5) < 0.5;
        dark += hidden;
        EXPECT_NEAR(shadow(x), hidden ? .75 : 0, 1e-5) << x;
    }
    EXPECT_EQ(dark, 8u);
}

TEST(LightLayers, NameShadersThatAreNotLinear) {
    SceneText scene;
    scene.square("s", 0.5)
        .look("toon", "surface toon() { Ci = step(.5, comp(diffuse(normalize(N)), 0)); }")
        .look("plain", kMatte)
        .place("s", "toon", "<translate>-.5 0 0</translate>")
        .place("s", "plain", "<translate>.5 0 0</translate>")
        .light("one", "<directional><color>.58 .58 .58</color></directional>")
        .light("two", "<directional><color>.66 .66 .66</color></directional>");
    const auto taken_frame = taken(scene, {{"light_*"}});
    const Rendering& r = *taken_frame;
    ASSERT_EQ(r.count("AOV_NOT_LINEAR"), 1) << r.findings();
    EXPECT_NE(r.findings().find("toon"), std::string::npos);
    EXPECT_EQ(r.findings().find("matte"), std::string::npos) << r.findings();
}

TEST(LightLayers, TraceNoRayAgainAndChangeNoPicture) {
    const auto plain_frame = taken(glass_and_mirror(), {{"cost"}, {}, 4}),
               taken_frame = taken(glass_and_mirror(),
                                   {{"cost", "direct", "indirect", "shadow", "light_*"}, {}, 4});
    EXPECT_EQ(difference(plain_frame->film, taken_frame->film), 0);
    EXPECT_EQ(plain_frame->film.aovs[0].values, taken_frame->film.aovs[0].values);
}

TEST(LightLayers, OfGroupsNeedLightsAndNames) {
    const auto taken_frame =
        taken(glass_and_mirror(), {{}, {"a=nosuch", "=sun", "direct=sun", "b=sun"}});
    const Rendering& r = *taken_frame;
    EXPECT_EQ(r.count("LIGHT_GROUP_EMPTY"), 1) << r.findings();
    EXPECT_EQ(r.count("LIGHT_GROUP_FORM"), 2) << r.findings();
    expect_color(layer(r, "b", 14, 8), {1, .5, 0}, "b");
}

}  // namespace
}  // namespace kinora
