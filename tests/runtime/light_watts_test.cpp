// tests/runtime/light_watts_test.cpp: lights that are in watts, against Blender's arithmetic;
// lights that leave a scene dark; Blender's grey world.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "expect_colors.h"

namespace kinora {
namespace {

const char* kBlender =
    "<extra><technique profile=\"blender\"><energy>1000</energy></technique></extra>";

std::string by(const char* tool) {
    return fmt::format(
        "<contributor><authoring_tool>{}</authoring_tool></contributor>"
        "<unit name=\"meter\" meter=\"1\"/><up_axis>Y_UP</up_axis>",
        tool);
}

// Without Blender's world.
SceneOptions own_lights() {
    SceneOptions options;
    options.lights = LightSet::Scene;
    return options;
}

std::string point(double watts) {
    return fmt::format(
        "<point><color>{0} {0} {0}</color><constant_attenuation>1</constant_attenuation>"
        "<linear_attenuation>0</linear_attenuation>"
        "<quadratic_attenuation>0.001111</quadratic_attenuation></point>",
        watts);
}

// A point of P watts sends P / (4 pi) in each direction (Blender's glTF exporter says the same); a
// white Lambert surface sends 1 / pi of what arrives.
double blender_point(double watts, dvec2 at, double height) {
    double d = std::sqrt(at.x * at.x + at.y * at.y + height * height);
    return watts / (4 * kPi * kPi * d * d) * height / d;
}

TEST(LightWatts, BlendersPointsShineAsBrightAsThere) {
    const struct {
        const char *tool, *extra;
        double watts;
    } rows[] = {{"Blender 2.93.4 commit date:2021-08-31, commit time:08:57", kBlender, 1000},
                {"Blender 3.4.1", kBlender, 20},
                {"Blender 2.80.75", "", 350},
                {"Open Asset Import Library", kBlender, 1000}};
    for (const auto& row : rows) {
        SceneText scene = floor_scene(kMatte);
        scene.asset = by(row.tool);
        scene.light("lamp", point(row.watts), "<translate>0 0 3</translate>", row.extra);
        Rendering r(scene.text(), own_lights());
        expect_colors(
            r.frame(), [&](dvec2 p) { return dvec3(blender_point(row.watts, p, 3)); }, 1e-5);
        EXPECT_EQ(r.count("LIGHT_WATTS"), 1) << row.tool << r.findings();
    }
}

TEST(LightWatts, BlendersSunIsIrradiance) {
    SceneText scene = floor_scene(kMatte);
    scene.asset = by("Blender 2.93.4");
    scene.light("sun", "<directional><color>2 1 0.5</color></directional>", "", kBlender);
    Rendering r(scene.text(), own_lights());
    r.frame();
    EXPECT_NEAR(r.color(8, 8).x, 2 / kPi, 1e-5);
}

TEST(LightWatts, OfADocumentInOtherUnitsAreByItsOwnDistances) {
    // Blender's picture is by its units, whatever a metre is.
    SceneText scene = floor_scene(kMatte);
    scene.asset = by("Blender 2.93.4");
    size_t at = scene.asset.find("meter=\"1\"");
    scene.asset.replace(at, 9, "meter=\"0.01\"");
    scene.light("lamp", point(1000), "<translate>0 0 3</translate>", kBlender);
    Rendering r(scene.text(), own_lights());
    expect_colors(
        r.frame(), [&](dvec2 p) { return dvec3(blender_point(1000, p, 3)); }, 1e-5);
}

TEST(LightWatts, LightsOfOldBlendersStayAsTheyStand) {
    for (const char* tool : {"Blender 2.74.0 commit date:2015-03-31", "Blender 2.79.0"}) {
        SceneText scene = floor_scene(kMatte);
        scene.asset = by(tool);
        scene.light("sun", "<directional><color>1.5 1.5 1.5</color></directional>", "", kBlender);
        Rendering r(scene.text(), own_lights());
        EXPECT_FLOAT_EQ(r.frame().color(8, 8).x, 1.5f);
        EXPECT_EQ(r.count("LIGHT_WATTS"), 0) << r.findings();
    }
}

TEST(LightWatts, OtherLightsAreScaledTogetherWhereTheyBurn) {
    // Facing the first: 20 + 30 cos 60 = 35. Facing the second: 30 + 20 cos 60 = 40.
    SceneText scene = floor_scene(kMatte);
    scene.light("a", "<directional><color>20 20 20</color></directional>")
        .light("b", "<directional><color>30 30 30</color></directional>",
               "<rotate>0 1 0 60</rotate>");
    Rendering r(scene.text(), own_lights());
    EXPECT_NEAR(r.frame().color(8, 8).x, 35.0 / 40, 1e-6);
    EXPECT_EQ(r.count("LIGHT_WATTS"), 1);
    ASSERT_TRUE(r.find("LIGHT_WATTS"));
    EXPECT_NE(r.find("LIGHT_WATTS")->message.find("40"), std::string::npos) << r.findings();
}

TEST(LightWatts, FourAtTheMiddleIsStillALight) {
    for (double strength : {4.0, 4.1}) {
        SceneText scene = floor_scene(kMatte);
        scene.light("a",
                    fmt::format("<directional><color>{0} {0} {0}</color></directional>", strength));
        Rendering r(scene.text(), own_lights());
        EXPECT_NEAR(r.frame().color(8, 8).x, strength > 4 ? 1 : 4, 1e-6);
        EXPECT_EQ(r.count("LIGHT_WATTS"), strength > 4 ? 1 : 0);
    }
}

TEST(LightWatts, TheMiddleIsJudgedByDistanceAndCone) {
    // 100 / 4 at the middle; the spot beside it looks elsewhere and is not counted.
    SceneText scene = floor_scene(kMatte);
    scene
        .light("lamp",
               "<point><color>100 100 100</color><constant_attenuation>0</constant_attenuation>"
               "<quadratic_attenuation>0.25</quadratic_attenuation></point>",
               "<translate>0 0 4</translate>")
        .light("spot", "<spot><color>90 90 90</color><falloff_angle>30</falloff_angle></spot>",
               "<translate>0 0 4</translate><rotate>0 1 0 40</rotate>");
    Rendering r(scene.text(), own_lights());
    EXPECT_NEAR(r.frame(15, 15).color(7, 7).x, 1, 1e-5) << r.findings();
    EXPECT_EQ(r.count("LIGHT_WATTS"), 1);
}

TEST(LightWatts, RslAndLegacyAreTheLetter) {
    SceneText scene = floor_scene(kMatte);
    scene.light("a", "<directional><color>300 300 300</color></directional>");
    SceneOptions legacy;
    legacy.decode_textures = false;
    Rendering r(scene.text(), legacy);
    EXPECT_FLOAT_EQ(r.frame().color(8, 8).x, 300);
    EXPECT_EQ(r.count("LIGHT_WATTS"), 0);
    SceneText own = floor_scene(kMatte);
    own.rsl_light("b", "light l() { solar(vector \"world\" (0, 0, -1), 0) Cl = 300; }");
    Rendering rsl(own.text());
    EXPECT_FLOAT_EQ(rsl.frame().color(8, 8).x, 300);
    EXPECT_EQ(rsl.count("LIGHT_WATTS"), 0);
}

// ---- lights that leave a scene dark

TEST(LightsDark, IsSaidOnceWhereOverHalfOfWhatIsSeenGetsNoLight) {
    SceneText scene = floor_scene(kMatte);
    scene.light("behind", "<directional><color>1 1 1</color></directional>",
                "<rotate>0 1 0 120</rotate>");
    Rendering r(scene.text());
    r.frame().frame(0.5);
    EXPECT_EQ(r.count("LIGHTS_DARK"), 1);
    ASSERT_TRUE(r.find("LIGHTS_DARK"));
    EXPECT_EQ(r.find("LIGHTS_DARK")->severity, Severity::Warning);
    EXPECT_NE(r.findings().find("--lights both"), std::string::npos);
}

TEST(LightsDark, IsDecidedInTheFirstFourFrames) {
    for (double night : {2.5, 3.5}) {  // when the sun has set
        SceneText scene = floor_scene(kMatte);
        scene.light("sun", "<directional><color sid=\"color\">1 1 1</color></directional>");
        scene.animate("sun/color.R", {0, night, night + 0.1}, {1, 1, 0})
            .animate("sun/color.G", {0, night, night + 0.1}, {1, 1, 0})
            .animate("sun/color.B", {0, night, night + 0.1}, {1, 1, 0});
        Rendering r(scene.text());
        for (int frame = 0; frame < 8; ++frame) r.frame(frame);
        EXPECT_EQ(r.color(8, 8).x, 0);
        EXPECT_EQ(r.count("LIGHTS_DARK"), night < 3) << r.findings();
    }
}

TEST(LightsDark, IsNotSaidOfWhatIsLitOrNeedsNoLightOrWasWanted) {
    const char* kAway = "<rotate>0 1 0 120</rotate>";
    SceneText lit = floor_scene(kMatte);
    lit.light("sun", kSun).light("behind", kSun, kAway);
    EXPECT_EQ(Rendering(lit.text()).frame().count("LIGHTS_DARK"), 0);
    SceneText black = floor_scene("surface s() { Oi = 1; Ci = 0 * diffuse(normalize(N)); }");
    black.light("sun", kSun);
    EXPECT_EQ(Rendering(black.text()).frame().count("LIGHTS_DARK"), 0);
    SceneText constant = floor_scene("surface s() { Oi = 1; Ci = 0; }");
    constant.light("behind", kSun, kAway);
    EXPECT_EQ(Rendering(constant.text()).frame().count("LIGHTS_DARK"), 0);
    SceneText dark = floor_scene(kMatte);
    dark.light("behind", kSun, kAway);
    for (LightSet set : {LightSet::Scene, LightSet::Both, LightSet::Default}) {
        SceneOptions options;
        options.lights = set;
        EXPECT_EQ(Rendering(dark.text(), options).frame().count("LIGHTS_DARK"), 0);
    }
    SceneText invisible = floor_scene("surface s() { Oi = 0; Ci = 0 * diffuse(N); }");
    invisible.light("behind", kSun, kAway);
    EXPECT_EQ(Rendering(invisible.text()).frame().count("LIGHTS_DARK"), 0);
}

// Under a sun at the zenith one square looks up and one down; the camera sees both.
TEST(LightsDark, CountsWhatIsSeenNotThePicture) {
    for (bool mostly_dark : {false, true}) {
        SceneText scene;
        scene.square("small", 0.3).square("large", 0.5).look("l", kMatte);
        const char* down = "<translate>0.5 0 0</translate><rotate>1 0 0 40</rotate>";
        const char* up = "<translate>-0.5 0 0</translate><rotate>1 0 0 -40</rotate>";
        scene.place(mostly_dark ? "small" : "large", "l", up)
            .place(mostly_dark ? "large" : "small", "l", down)
            .light("sun", "<directional><color>1 1 1</color></directional>",
                   "<rotate>1 0 0 -90</rotate>");
        EXPECT_EQ(Rendering(scene.text()).frame(32, 32).count("LIGHTS_DARK"), mostly_dark);
    }
}

// ---- the world that Blender lights with too

const char* kBothSides = "surface s() { Oi = 1; Ci = diffuse(faceforward(normalize(N), I)); }";
const char* kSun = "<directional><color>1 1 1</color></directional>";
const char* kFromBehind = "<rotate>0 1 0 150</rotate>";

SceneText behind_lit(const std::string& asset, const std::string& turn = "") {
    SceneText scene;
    scene.asset = asset;
    return scene.square("wall", 3)
        .look("l", kBothSides)
        .place("wall", "l", turn)
        .light("sun", kSun, kFromBehind);
}

bool has_world(const Rendering& r) {
    const auto& added = r.scene->added;
    return std::ranges::find(added, "grey world") != added.end();
}

// A white surface in a sphere of brightness 0.05 is as bright, whichever side is seen however.
TEST(GreyWorld, LightsWhatBlendersLampsLeaveDark) {
    for (const char* tool : {"Blender v:249 - Illusoft Collada Exporter v:0.3.162",
                             "Blender 2.79.0 commit date:2018-03-22", "Blender 3.4.1"})
        for (const char* turn : {"", "<rotate>1 0 0 25</rotate>", "<rotate>0 1 0 180</rotate>"}) {
            Rendering r(behind_lit(by(tool), turn).text());
            r.frame().frame(0.5);
            EXPECT_NEAR(r.color(8, 8).x, 0.05, 1e-6) << tool << turn;
            EXPECT_TRUE(has_world(r));
            EXPECT_EQ(r.count("LIGHTS_WORLD"), 1);
            ASSERT_TRUE(r.find("LIGHTS_WORLD"));
            EXPECT_EQ(r.find("LIGHTS_WORLD")->severity, Severity::Info);
            EXPECT_EQ(r.count("LIGHTS_DARK"), 1) << "it is no light of the scene";
        }
}

TEST(GreyWorld, AddsToWhatTheLampsLightWithoutHighlights) {
    SceneText scene = floor_scene(
        "surface s() { Oi = 1; normal n = normalize(N);"
        " Ci = color(1, 0, 0) * diffuse(n) + color(0, 1, 0) * phong(n, -normalize(I), 0); }");
    scene.asset = by("Blender 2.79.0");
    scene.light("sun", kSun, "<rotate>0 1 0 60</rotate>");
    Rendering r(scene.text());
    EXPECT_NEAR(r.frame().color(8, 8).x, 0.5 + 0.05, 1e-5);
    EXPECT_NEAR(r.color(8, 8).y, 1, 1e-5);  // pow(x, 0) of the sun alone
    EXPECT_EQ(r.count("LIGHTS_DARK"), 0);
}

// A night scene stays one, and so does every picture that does not come from Blender.
TEST(GreyWorld, LeavesOtherProgramsScenesAsTheyAre) {
    const char* kMoon = "<directional><color>0.02 0.02 0.03</color></directional>";
    for (const char* tool : {"", "FBX COLLADA exporter", "Autodesk Maya 2019", "SketchUp 8.0",
                             "modo 701", "Open Asset Import Library", "not Blender 3.4.1"}) {
        SceneText night = behind_lit(by(tool));
        night.light("moon", kMoon, "<rotate>0 1 0 30</rotate>").octahedron("ball");
        night.place("ball", "l", "<scale>0.6 0.6 0.6</scale>");
        Rendering by_default(night.text()), alone(night.text(), own_lights());
        by_default.frame(), alone.frame();
        EXPECT_TRUE(same_bytes(by_default.film, alone.film)) << tool;
        EXPECT_LT(by_default.color(0, 0).x, 0.005f);
        EXPECT_FALSE(has_world(by_default));
        EXPECT_EQ(by_default.count("LIGHTS_WORLD"), 0);
    }
}

TEST(GreyWorld, IsNotThereWhereItIsNotWanted) {
    SceneText scene = behind_lit(by("Blender 2.79.0"));
    auto middle = [](const SceneText& of, const SceneOptions& options) {
        Rendering r(of.text(), options);
        r.frame();
        EXPECT_FALSE(has_world(r));
        EXPECT_EQ(r.count("LIGHTS_WORLD"), 0);
        return r.color(8, 8).x;
    };
    EXPECT_EQ(middle(scene, own_lights()), 0);
    SceneOptions legacy;
    legacy.decode_textures = false;
    EXPECT_EQ(middle(scene, legacy), 0);
    SceneOptions both;  // the default lights are there instead
    both.lights = LightSet::Both;
    EXPECT_GT(middle(scene, both), 0.3f);
    SceneText unlit = floor_scene(kBothSides);
    unlit.asset = by("Blender 2.79.0");
    EXPECT_GT(middle(unlit, {}), 0.3f);
    SceneText own = floor_scene(kMatte);  // a light in RSL is meant as it is
    own.asset = by("Blender 2.79.0");
    own.rsl_light("b", "light l() { solar(vector \"world\" (0, 0, 1), 0) Cl = 1; }");
    EXPECT_EQ(middle(own, {}), 0);
}

}  // namespace
}  // namespace kinora
