// tests/runtime/lighting_test.cpp: lights, shadows and transparency against arithmetic by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "expect_colors.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {
namespace {

std::string turned(const char* axis, double degrees) {
    return fmt::format("<rotate>{} {}</rotate>", axis, degrees);
}

TEST(Lights, AMatteSquareUnderADirectionalLightIsTheCosineEverywhere) {
    for (double angle : {0.0, 30.0, 60.0, 85.0, 100.0}) {
        SceneText scene = floor_scene(kMatte);
        scene.light("sun", kSun, turned("1 0 0", angle));
        double want = std::max(0.0, std::cos(radians(angle)));
        expect_colors(Rendering(scene.text()).frame(), [&](dvec2) { return dvec3(want); });
    }
}

TEST(Lights, ColoursOfSeveralLightsAddUp) {
    SceneText scene = floor_scene(kMatte);
    scene.light("a", "<directional><color>0.5 0.25 2</color></directional>")
        .light("b", "<directional><color>0.1 1 0</color></directional>", turned("0 1 0", 60));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) {
        // Decoded from sRGB: 2 (1/4, 1/8, 1) and half of (0.1, 1, 0).
        return dvec3(2 * 0.0508760882 + 0.0100228256 / 2, 2 * 0.0143498747 + 0.5, 2);
    });
}

TEST(Lights, PointLightsFallOffByTheirThreeAttenuations) {
    SceneText scene = floor_scene(kMatte);
    scene.light("bulb",
                "<point><color>2 2 2</color><constant_attenuation>0.5</constant_attenuation>"
                "<linear_attenuation>0.25</linear_attenuation>"
                "<quadratic_attenuation>0.125</quadratic_attenuation></point>",
                "<translate>0.5 -0.25 0.75</translate>");
    expect_colors(Rendering(scene.text()).frame(), [](dvec2 p) {
        double d = std::sqrt((p.x - 0.5) * (p.x - 0.5) + (p.y + 0.25) * (p.y + 0.25) + 0.75 * 0.75);
        return dvec3(2 * (0.75 / d) / (0.5 + 0.25 * d + 0.125 * d * d));
    });
}

TEST(Lights, ASpotLightsUpTheInsideOfItsConeOnly) {
    SceneText scene = floor_scene(kMatte);
    scene.light("spot",
                "<spot><color>1 1 1</color><falloff_angle>40</falloff_angle>"
                "<falloff_exponent>3</falloff_exponent></spot>",
                "<translate>0 0 2</translate>");
    Rendering r(scene.text());
    r.frame(32, 32);
    int lit = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            dvec2 p = r.place(x, y);
            double radius = std::hypot(p.x, p.y), angle = std::atan2(radius, 2.0) * 180 / kPi;
            if (std::abs(angle - 20) < 0.01) continue;
            double cosine = std::cos(radians(angle));
            double want = angle < 20 ? std::pow(cosine, 4) : 0;
            ASSERT_NEAR(r.color(x, y).x, want, 3e-6) << x << "," << y;
            lit += angle < 20;
        }
    EXPECT_GT(lit, 100);
}

// Lights are left out by where things are in the frame, not where they were in the first one.
TEST(Lights, ASpotLightsWhatComesIntoItsCone) {
    SceneText scene;
    scene.look("matte", kMatte)
        .square("sheet", 1)
        .place("sheet", "matte", "<translate sid=\"t\">0 0 0</translate>", "sheet-node")
        .light("spot", "<spot><color>1 1 1</color><falloff_angle>60</falloff_angle></spot>",
               "<translate>0 0 2</translate>");
    scene.animate("sheet-node/t.Z", {0, 1}, {4, 0});
    Rendering r(scene.text());
    for (double time : {0.0, 1.0, 0.0, 1.0}) {
        r.frame(31, 31, time);
        EXPECT_NEAR(r.color(15, 15).x, time, 1e-6) << r.findings();
        EXPECT_EQ(r.stats.light_points > 0, time > 0);
    }
}

TEST(Lights, AmbientLightReachesEveryPointEvenly) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = ambient(); }");
    scene.light("sky", "<ambient><color>0.1 0.2 0.3</color></ambient>").light("sun", kSun);
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) {
        return dvec3(0.0100228256, 0.0331047666, 0.0732389559);  // decoded from sRGB
    });
}

TEST(Lights, IlluminanceTakesTheLightsInsideItsConeOnly) {
    SceneText scene =
        floor_scene("surface s() { Oi = 1; Ci = 0; illuminance(P, N, radians(45)) { Ci += Cl; } }");
    scene.light("inside", "<directional><color>1 0 0</color></directional>", turned("1 0 0", 40))
        .light("outside", "<directional><color>0 1 0</color></directional>", turned("1 0 0", 50));
    expect_colors(Rendering(scene.text()).frame(), [](dvec2) { return dvec3(1, 0, 0); });
}

TEST(Lights, IlluminanceByCategoryTakesThatCategoryOnly) {
    SceneText scene = floor_scene(
        "surface s() { Oi = 1; Ci = 0;"
        "  illuminance(\"key\", P, N, PI/2) { Ci += Cl; }"
        "  illuminance(\"-key\", P, N, PI/2) { Ci += 10 * Cl; } }");
    scene
        .rsl_light("a",
                   "light a(string __category = \"fill,key\") {"
                   " solar(vector \"shader\" (0,0,1), 0) Cl = color(1,0,0); }")
        .rsl_light("b",
                   "light b(string __category = \"fill\") {"
                   " solar(vector \"shader\" (0,0,1), 0) Cl = color(0,1,0); }");
    Rendering r(scene.text());
    expect_colors(r.frame(), [](dvec2) { return dvec3(1, 10, 0); });
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
}

// RenderMan's: x right, y up, z where the light looks. A node that is named has its own axes.
TEST(Lights, ShaderSpaceLooksAlongZ) {
    SceneText scene =
        floor_scene("surface s() { Oi = 1; Ci = 0; illuminance(P, N, PI/2) Ci += Cl; }");
    scene.rsl_light("lamp",
                    "light lamp(string space = \"shader\";) {"
                    "  point a = transform(\"shader\", Ps), b = transform(\"lamp-node\", Ps);"
                    "  point c = transform(space, Ps), d = transform(concat(\"obj\", \"ect\"), Ps);"
                    "  float alike = distance(a, c) + distance(a, d) < 1e-5 ? 1 : 0;"
                    "  illuminate(point \"shader\" (0, 0, 0), vector \"shader\" (0, 0, 1), PI / 2)"
                    "    Cl = alike * color(xcomp(a), ycomp(a), zcomp(a) + 10 * zcomp(b)); }",
                    "<translate>0.25 0.5 2</translate>");
    Rendering r(scene.text());
    expect_colors(r.frame(), [](dvec2 p) { return dvec3(p.x - 0.25, p.y - 0.5, 2 - 20); });
    EXPECT_EQ(r.findings(), "");
}

// Customary lights aim at their defaults: a spotlight of the specification lights what is below it.
TEST(Lights, CustomaryLightsNeedNoTurning) {
    SceneText scene = floor_scene(kMatte);
    scene.rsl_light("lamp",
                    "light spot(point from = point \"shader\" (0, 0, 0);"
                    "           point to = point \"shader\" (0, 0, 1); float coneangle = 1.5;) {"
                    "  uniform vector A = (to - from) / length(to - from);"
                    "  illuminate(from, A, coneangle) Cl = 1; }",
                    "<translate>0 0 2</translate>");
    Rendering r(scene.text());
    expect_colors(r.frame(),
                  [](dvec2 p) { return dvec3(2 / std::sqrt(p.x * p.x + p.y * p.y + 4)); });
    EXPECT_EQ(r.findings(), "");
}

TEST(Lights, ThatAimBackAreNamed) {
    auto named = [](const std::string& statement) {
        SceneText scene = floor_scene(kMatte);
        scene.rsl_light("lamp", "light l() { " + statement + " Cl = 1; }",
                        "<translate>0.1 0.2 3</translate><rotate>1 0 0 10</rotate>");
        Rendering r(scene.text());
        r.frame();
        return r.findings().find("LIGHT_AIMS_BACK") != std::string::npos;
    };
    EXPECT_TRUE(named("solar(vector \"shader\" (0, 0, -1), 0)"));
    EXPECT_TRUE(named("illuminate(P, vector \"shader\" (0, 0, -1), 0.02)"));
    EXPECT_TRUE(named("illuminate(P, vector \"shader\" (0.3, 0, -1), 0.5)"));
    EXPECT_FALSE(named("solar(vector \"shader\" (0, 0, 1), 0)"));
    EXPECT_FALSE(named("illuminate(P, vector \"shader\" (0, 0, 1), 0.02)"));
    EXPECT_FALSE(named("illuminate(P)"));
    EXPECT_FALSE(named("illuminate(P, vector \"shader\" (0, 0, -1), 3)"));
}

TEST(Lights, SurfacesReadALightsParametersAndOutputs) {
    SceneText scene = floor_scene(
        "surface s() { Oi = 1; Ci = 0; float gain = -1, reach = -1, none = 5;"
        "  illuminance(P, N, PI/2) {"
        "    float has = lightsource(\"gain\", gain);"
        "    has += lightsource(\"reach\", reach);"
        "    has += lightsource(\"nothing_here\", none);"
        "    Ci = color(gain, reach, has); } }");
    scene.rsl_light("lamp",
                    "light lamp(float gain = 0.25; output varying float reach = 0;) {"
                    "  illuminate(P) { reach = length(L); Cl = 1; } }",
                    "<translate>0 0 2</translate>");
    Rendering r(scene.text());
    expect_colors(r.frame(),
                  [](dvec2 p) { return dvec3(0.25, std::sqrt(p.x * p.x + p.y * p.y + 4), 2); });
}

TEST(Lights, RslLightsStandWhereTheirNodeStands) {
    SceneText scene = floor_scene(kMatte);
    scene.rsl_light("lamp",
                    "light lamp(float intensity = 1; point from = point \"shader\" (0,0,0);) {"
                    "  illuminate(from) Cl = intensity / (L . L); }",
                    "<translate>0.5 0 1</translate>",
                    "<bind symbol=\"intensity\"><float>3</float></bind>");
    expect_colors(
        Rendering(scene.text()).frame(),
        [](dvec2 p) {
            double d2 = (p.x - 0.5) * (p.x - 0.5) + p.y * p.y + 1;
            return dvec3(3 / d2 / std::sqrt(d2));
        },
        5e-6);
}

// ---- shadows

// A small square above the floor under light slanting by 30 degrees about y: its shadow is the
// square moved by -tan(30).
SceneText shadow_scene(const char* occluder_code, const char* light_extra = "") {
    SceneText scene = floor_scene(kMatte);
    scene.square("small", 0.25)
        .look("cover", occluder_code)
        .place("small", "cover", "<translate>0 0 1</translate>")
        .light("sun", kSun, turned("0 1 0", 30), light_extra);
    return scene;
}

enum class Region { Occluder, Shadow, Lit, Edge };
Region region_of(dvec2 p) {
    double moved = p.x + std::tan(radians(30.0)), edge = 1e-4;
    auto inside = [&](double x, double grow) {
        return std::abs(x) < 0.25 + grow && std::abs(p.y) < 0.25 + grow;
    };
    if (inside(p.x, -edge)) return Region::Occluder;
    if (inside(p.x, edge)) return Region::Edge;
    if (inside(moved, -edge)) return Region::Shadow;
    return inside(moved, edge) ? Region::Edge : Region::Lit;
}

void expect_shadow(const SceneText& scene, dvec3 share, const SceneOptions& options = {}) {
    Rendering r(scene.text(), options);
    r.frame(64, 64);
    int shadowed = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            Region region = region_of(r.place(x, y));
            if (region == Region::Occluder || region == Region::Edge) continue;
            dvec3 want = std::cos(radians(30.0)) * (region == Region::Shadow ? share : dvec3(1));
            for (int k = 0; k < 3; ++k)
                ASSERT_NEAR(r.color(x, y)[k], want[k], 2e-6) << x << "," << y << r.findings();
            shadowed += region == Region::Shadow;
        }
    EXPECT_GT(shadowed, 200);
}

TEST(Shadows, HaveExactlyTheExtentOfTheProjection) {
    expect_shadow(shadow_scene("surface s() { Oi = 1; Ci = 1; }"), dvec3(0));
}

TEST(Shadows, ThroughTransparentSurfacesAreTintedByTheirOpacity) {
    expect_shadow(shadow_scene("surface s() { Oi = 0.5; Ci = 0; }"), dvec3(0.5));
    expect_shadow(shadow_scene("surface s() { Oi = color(1, 0, 0.25); Ci = 0; }"),
                  dvec3(0, 1, 0.75));
    // Computed, not constant.
    expect_shadow(shadow_scene("surface s() { Oi = 0.5 + 0 * noise(P); Ci = 0; }"), dvec3(0.5));
}

TEST(Shadows, OpacitiesOfSeveralSurfacesMultiply) {
    SceneText straight = floor_scene(kMatte);
    straight.square("big", 2).look("cover", "surface s() { Oi = 0.5; Ci = 0; }");
    for (double z : {20.0, 30.0, 40.0})
        straight.place("big", "cover", fmt::format("<translate>0 0 {}</translate>", z));
    straight.light("sun", kSun);
    expect_colors(Rendering(straight.text()).frame(), [](dvec2) { return dvec3(0.125); });
}

TEST(Shadows, OfAPointLightEndAtTheLight) {
    SceneText scene = floor_scene(kMatte);
    scene.square("big", 2)
        .look("cover", "surface s() { Oi = 1; Ci = 1; }")
        .place("big", "cover", "<translate>0 0 20</translate>")  // behind light and camera
        .light("bulb", "<point><color>1 1 1</color></point>", "<translate>0 0 3</translate>");
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2 p) { return dvec3(3 / std::sqrt(p.x * p.x + p.y * p.y + 9)); });
}

TEST(Shadows, AreOffWhereTheLightOrTheOptionSaysSo) {
    const char* code = "surface s() { Oi = 1; Ci = 1; }";
    const char* off = "<extra><technique profile=\"RSL\"><shadows>0</shadows></technique></extra>";
    const char* on = "<extra><technique profile=\"RSL\"><shadows>1</shadows></technique></extra>";
    SceneOptions options;
    expect_shadow(shadow_scene(code, off), dvec3(1));
    options.quality.shadows = ShadowMode::Off;
    expect_shadow(shadow_scene(code), dvec3(1), options);
    options.quality.shadows = ShadowMode::Explicit;
    expect_shadow(shadow_scene(code), dvec3(1), options);
    expect_shadow(shadow_scene(code, on), dvec3(0), options);
}

TEST(Shadows, OfASurfaceDoNotFallOnItself) {
    SceneText scene = floor_scene(kMatte);
    scene.light("sun", kSun, turned("1 0 0", 89.5));
    double want = std::cos(radians(89.5));
    expect_colors(Rendering(scene.text()).frame(64, 64), [&](dvec2) { return dvec3(want); });
}

// ---- ambient light on textures

// An image beside the scenes of tests, 51 102 204 everywhere; removed with the object.
struct BlueImage {
    std::string name = "kinora_lighting_test_" + std::to_string(getpid()) + ".png";
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    BlueImage() {
        Image8 image{4, 4, {}};
        for (int k = 0; k < 16; ++k) image.rgba.insert(image.rgba.end(), {51, 102, 204, 255});
        EXPECT_EQ(write_png(path.string(), image, {}), "");
    }
    ~BlueImage() { std::filesystem::remove(path); }
};

// A square in a fixed-function material under ambient light of 1, in the numbers of the file.
vec3 under_ambient_light(const char* model, const std::string& slots) {
    BlueImage image;
    SceneText scene;
    scene.images = "<image id=\"blue\"><init_from>" + image.name + "</init_from></image>";
    scene.effects = fmt::format(
        "<effect id=\"l-fx\"><profile_COMMON>"
        "<newparam sid=\"blue-surface\"><surface type=\"2D\"><init_from>blue</init_from></surface>"
        "</newparam><newparam sid=\"blue-sampler\"><sampler2D><source>blue-surface</source>"
        "</sampler2D></newparam><technique sid=\"t\"><{0}>{1}</{0}></technique></profile_COMMON>"
        "</effect>",
        model, slots);
    scene.materials = "<material id=\"l\"><instance_effect url=\"#l-fx\"/></material>";
    scene.square("wall", 2)
        .place("wall", "l")
        .light("sky", "<ambient><color>1 1 1</color></ambient>")
        .light("away", kSun, turned("1 0 0", 180));
    SceneOptions legacy;
    legacy.decode_textures = false;
    Rendering r(scene.text(), legacy);
    vec3 seen = r.frame().color(8, 8);
    EXPECT_EQ(r.count("IMAGE_UNREADABLE"), 0) << r.findings();
    return seen;
}

TEST(AmbientLight, IsColouredByTheTextureOfDiffuse) {
    const std::string texture = "<texture texture=\"blue-sampler\" texcoord=\"UV\"/>";
    const std::string half = "<color>0.5 0.5 1 1</color>";
    constexpr double kHalf = 0.2140411405;  // of 0.5: ((0.5 + 0.055) / 1.055) ^ 2.4
    auto slots = [](const std::string& ambient, const std::string& diffuse) {
        return "<ambient>" + ambient + "</ambient><diffuse>" + diffuse + "</diffuse>";
    };
    struct {
        std::string ambient, diffuse;
        dvec3 want;
    } rows[] = {{half, texture, {0.2 * kHalf, 0.4 * kHalf, 0.8}},  // locked: the texture's color
                {texture, texture, {0.2, 0.4, 0.8}},  // its own texture is not applied twice
                {texture, half, {0.2, 0.4, 0.8}},
                {half, half, {kHalf, kHalf, 1}}};  // colors are two things
    for (const char* model : {"lambert", "phong", "blinn"})
        for (const auto& row : rows) {
            vec3 seen = under_ambient_light(model, slots(row.ambient, row.diffuse));
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(seen[k], row.want[k], 1e-3) << model << row.ambient << row.diffuse;
        }
}

// ---- transparency

TEST(Transparency, LayersCompositeFrontToBack) {
    SceneText scene = floor_scene("surface s() { Oi = 1; Ci = color(0, 1, 0); }");
    scene.square("pane", 2)
        .look("red", "surface s() { Oi = 0.5; Ci = color(0.5, 0, 0); }")
        .look("blue", "surface s() { Oi = color(0.2, 0.4, 0.8); Ci = color(0, 0, 0.1); }")
        .place("pane", "blue", "<translate>0 0 1</translate>")
        .place("pane", "red", "<translate>0 0 2</translate>")
        .light("sun", kSun);
    // 0.5 red + 0.5 (0.1 blue + (1 - Oi) green)
    expect_colors(Rendering(scene.text()).frame(),
                  [](dvec2) { return dvec3(0.5, 0.5 * 0.6, 0.5 * 0.1); });
}

TEST(Transparency, AlphaIsTheMeanOpacity) {
    SceneText scene;
    scene.square("pane", 2)
        .look("glass", "surface s() { Oi = color(0.2, 0.4, 0.9); Ci = 0; }")
        .place("pane", "glass");
    Rendering r(scene.text());
    r.frame();
    EXPECT_NEAR(r.film.at(8, 8).w, 0.5, 1e-6);
}

TEST(Transparency, ReflectionsAreTracedAndEndAtTheDepthLimit) {
    // Two mirrors face each other: each adds 0.5 of what it reflects to its own 1: 1 + 1/2 + 1/4...
    SceneText scene;
    scene.square("mirror", 50)
        .look(
            "mirror",
            "surface s() { Oi = 1; Ci = 1 + 0.5 * trace(P, reflect(normalize(I), normalize(N))); }")
        .place("mirror", "mirror")
        .place("mirror", "mirror", "<translate>0 0 12</translate>");
    Rendering r(scene.text());
    r.frame();
    float got = r.color(8, 8).x;
    EXPECT_GT(got, 1.99f) << r.findings();
    EXPECT_LE(got, 2.0f);
}

TEST(Lights, SharesThatAreAnimatedAreThoseOfTheFrame) {
    for (const char* name : {"__nondiffuse", "__nonspecular"}) {
        SceneText scene = floor_scene(
            "surface s() { Oi = 1; vector up = vector \"world\" (0, 0, 1);"
            " Ci = color(comp(diffuse(normalize(N)), 0), comp(specular(normalize(N), up, 0.1), 0),"
            " 0); }");
        scene.look("lamp-look",
                   fmt::format("light l(float {} = 0;) {{ solar(vector \"world\" (0, 0, -1), 0)"
                               " Cl = 1; }}",
                               name),
                   fmt::format("<shader stage=\"LIGHT\"><bind symbol=\"{}\"><param ref=\"share\"/>"
                               "</bind></shader>",
                               name),
                   "<newparam sid=\"share\"><float>0</float></newparam>");
        scene.light("lamp", "<point><color>1 1 1</color></point>", "",
                    rsl_extra("<instance_effect url=\"#lamp-look-fx\"/>"));
        scene.animate("lamp-look-fx/share", {0, 1}, {0, 1});
        Rendering r(scene.text());
        bool diffuse = std::string(name) == "__nondiffuse";
        for (double time : {0.0, 1.0, 0.25}) {
            dvec3 want(1, 1, 0);
            want[diffuse ? 0 : 1] = 1 - time;
            expect_colors(
                r.frame(time), [&](dvec2) { return want; }, 1e-5);
        }
    }
}

}  // namespace
}  // namespace kinora
