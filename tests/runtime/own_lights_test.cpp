// tests/runtime/own_lights_test.cpp: scenes that their own lights leave black get the default
// lights, and no others do.
#include "runtime/picture/frame/own_lights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_text.h"

namespace kinora {
namespace {

const char* kMatteBoth = "surface s() { Oi = 1; Ci = diffuse(faceforward(normalize(N), I)); }";
const char* kWhiteSun = "<directional><color>1 1 1</color></directional>";
const char* kBehind = "<rotate>0 1 0 120</rotate>";
// One that shines only in the second second of twelve.
const char* kSwitched = "<directional><color sid=\"color\">0 0 0</color></directional>";

SceneText wall() {
    return floor_scene(kMatteBoth);
}

SceneOptions with_lights(LightSet lights) {
    SceneOptions options;
    options.lights = lights;
    return options;
}

bool is_added_to(Rendering& r) {
    EXPECT_TRUE(light_black_scene(*r.scene, *r.pose, r.diagnostics)) << r.findings();
    const auto& added = r.scene->added;
    bool lights = std::ranges::find(added, "default key light") != added.end();
    EXPECT_EQ(r.count("LIGHTS_BLACK"), int(lights)) << r.findings();
    return lights;
}

// The picture of --lights both, and the warning at the first light.
TEST(OwnLights, BlackScenesGetTheDefaultLights) {
    const char* kInside = "<point><color>1 1 1</color></point>";
    struct {
        const char* what;
        SceneText scene;
    } cases[] = {
        {"away", wall().light("l", kWhiteSun, kBehind)},
        {"black", wall().light("l", "<directional><color>0 0 0</color></directional>")},
        {"dim", wall().light("l", "<directional><color>0.02 0.02 0.02</color></directional>")},
        {"narrow", wall().light("l",
                                "<spot><color>1 1 1</color><falloff_angle>0"
                                "</falloff_angle></spot>",
                                "<translate>0.5 0.31 3</translate>")},
        {"inside",
         SceneText().cube("box", 0.5).look("x", kMatteBoth).place("box", "x").light("l", kInside)}};
    for (auto& [what, scene] : cases) {
        SCOPED_TRACE(what);
        Rendering r(scene.text());
        ASSERT_TRUE(is_added_to(r));
        EXPECT_EQ(r.find("LIGHTS_BLACK")->severity, Severity::Warning);
        EXPECT_EQ(r.file_text.substr(r.find("LIGHTS_BLACK")->where.begin, 6), "<light");
        EXPECT_NE(r.findings().find("--lights scene"), std::string::npos);
        Rendering both(scene.text(), with_lights(LightSet::Both));
        EXPECT_TRUE(same_bytes(r.frame().film, both.frame().film));
        EXPECT_GT(r.color(8, 8).x, 0.1);
        EXPECT_EQ(r.count("LIGHTS_DARK"), 0);
    }
}

// In place of the grey world: as with --lights both.
TEST(OwnLights, BlendersScenesGetThemInPlaceOfTheGreyWorld) {
    SceneText scene = wall().light("l", kWhiteSun, kBehind);
    scene.asset =
        "<contributor><authoring_tool>Blender 2.79.0</authoring_tool></contributor>"
        "<created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>";
    Rendering r(scene.text()), both(scene.text(), with_lights(LightSet::Both));
    ASSERT_TRUE(is_added_to(r));
    EXPECT_TRUE(same_bytes(r.frame().film, both.frame().film));
    EXPECT_EQ(r.scene->world_light, 0);
}

TEST(OwnLights, OneTimeOfTheRangeThatIsLitIsEnough) {
    for (bool night : {false, true}) {
        SceneText scene = wall().light("sun", kSwitched);
        for (const char* part : {"sun/color.R", "sun/color.G", "sun/color.B"})
            scene.animate(part, {0, 6.5, 7, 7.5, 12}, {0, 0, night ? 0.0 : 1.0, 0, 0});
        SceneOptions options;
        options.end_time = 12;
        Rendering r(scene.text(), options);
        EXPECT_EQ(is_added_to(r), night);
        EXPECT_EQ(r.frame(0).color(8, 8).x > 0.1f, night);
    }
}

// What is drawn after is the picture that would have been.
TEST(OwnLights, LitScenesKeepTheirBits) {
    SceneText scene = wall().light("sun", kWhiteSun, "<rotate>0 1 0 30</rotate>");
    scene.look("x", kMatteBoth).bending_strip("arm", "x", 4);
    SceneOptions options;
    options.end_time = 1;
    for (double time : {0.0, 0.7}) {
        Rendering probed(scene.text(), options), plain(scene.text(), options);
        EXPECT_FALSE(is_added_to(probed));
        EXPECT_TRUE(same_bytes(probed.frame(time).film, plain.frame(time).film));
        EXPECT_EQ(probed.findings(), plain.findings());
    }
}

// A tenth of what is seen is lit: a lamp at night, which --lights both may help.
TEST(OwnLights, ALampAtNightIsEnough) {
    SceneText scene = wall();
    scene.light("lamp", "<spot><color>1 1 1</color><falloff_angle>8</falloff_angle></spot>",
                "<translate>0 0 5</translate>");
    Rendering r(scene.text());
    EXPECT_FALSE(is_added_to(r));
    EXPECT_EQ(r.frame(64, 64).count("LIGHTS_DARK"), 1);
}

// What only mirrors is not black where nothing stands around it; in lights of a file it is.
TEST(DefaultLights, AMirrorInAnEmptySceneGlows) {
    SceneText scene;
    scene.octahedron("ball");
    auto chrome = [](const char* diffuse) {
        return std::string(
                   "<effect id=\"chrome-fx\"><profile_COMMON><technique sid=\"c\"><phong>"
                   "<diffuse><color>") +
               diffuse +
               " 1</color></diffuse><reflective><color>1 1 1 1</color></reflective><reflectivity>"
               "<float>1</float></reflectivity></phong></technique></profile_COMMON></effect>";
    };
    scene.materials = "<material id=\"chrome\"><instance_effect url=\"#chrome-fx\"/></material>";
    scene.place("ball", "chrome", "<scale>0.8 0.8 0.8</scale>");
    scene.effects = chrome("0 0 0");
    Rendering glows(scene.text());
    EXPECT_GT(glows.frame().color(9, 6).x, 0.02) << glows.findings();
    scene.light("sun", kWhiteSun);
    Rendering lit(scene.text());
    EXPECT_EQ(lit.frame().color(9, 6).x, 0) << lit.findings();
}

TEST(OwnLights, RslAndOptionsAreTheLetter) {
    SceneText own =
        wall().rsl_light("b", "light l() { solar(vector \"world\" (0, 0, 1), 0) Cl = 1; }");
    Rendering rsl(own.text());
    EXPECT_FALSE(is_added_to(rsl));
    SceneText away = wall().light("l", kWhiteSun, kBehind);
    Rendering letter(away.text(), with_lights(LightSet::Scene));
    EXPECT_FALSE(is_added_to(letter));
    SceneOptions legacy;
    legacy.decode_textures = false;
    Rendering old(away.text(), legacy);
    EXPECT_FALSE(is_added_to(old));
    EXPECT_EQ(old.frame().color(8, 8).x, 0);
}

}  // namespace
}  // namespace kinora
