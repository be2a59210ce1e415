// tests/runtime/volume_test.cpp: atmosphere, interiors and exteriors against arithmetic by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "jit/target.h"
#include "runtime/picture/shading/shading.h"
#include "runtime/scene/medium.h"
#include "scene_text.h"
#include "tests/folders.h"

namespace kinora {
namespace {

const char* kFog =
    "volume fog(float distance = 7; color background = color(0, 0.25, 1)) {"
    "  float d = 1 - exp(-length(I) / distance);"
    "  Ci = mix(Ci, background, d); Oi = mix(Oi, color(1), d); }";
const char* kVolume = "<shader stage=\"VOLUME\"/>";
const char* kEmpty = "surface empty() { Oi = 0; Ci = 0; }";
const dvec3 kBackground(0, 0.25, 1);

dvec3 fogged(dvec3 color, double length, double distance = 7) {
    double d = 1 - std::exp(-length / distance);
    return color * (1 - d) + kBackground * d;
}

void expect_near(vec3 got, dvec3 want, double tolerance = 2e-6) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], tolerance) << "component " << k;
}

std::string plain(dvec3 color, double opacity = 1) {
    return fmt::format("surface s() {{ Oi = {}; Ci = color({}, {}, {}) * Oi; }}", opacity, color.x,
                       color.y, color.z);
}

SceneText fog_scene() {
    SceneText scene;
    return scene.scene_effect("fog", kFog, kVolume);
}

// A cube that is not seen itself but holds a volume.
SceneText& filled_cube(SceneText& scene, const std::string& id, const std::string& volume,
                       double size, const std::string& transforms = "",
                       const std::string& material_extra = "") {
    return scene.cube(id, size)
        .look(id + "-look", std::string(kEmpty) + "\n" + volume,
              std::string("<shader stage=\"SURFACE\"/>") + kVolume, "", material_extra)
        .place(id, id + "-look", transforms);
}

TEST(Atmosphere, FadesASurfaceByTheExponentialOfItsDistance) {
    SceneText scene = fog_scene();
    scene.square("floor", 1.5).look("floor-look", plain({1, 0.5, 0}));
    scene.place("floor", "floor-look", "<rotate>1 0 0 60</rotate>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.count("RSL_STAGE_NOT_RENDERED"), 0);
    int seen = 0;
    for (int y = 0; y < 16; ++y) {
        dvec2 p = r.place(3, y);
        if (std::abs(p.y) > 0.7) continue;
        expect_near(r.color(3, y), fogged({1, 0.5, 0}, 10 - p.y * std::tan(radians(60.0))));
        EXPECT_NEAR(r.film.at(3, y).w, 1, 1e-6);
        ++seen;
    }
    EXPECT_GT(seen, 8);
}

TEST(Atmosphere, WhereNothingIsTheFogReachesToTheFarClip) {
    Rendering r(fog_scene().text());
    r.frame();
    double d = 1 - std::exp(-100.0 / 7);
    expect_near(r.color(5, 5), kBackground * d);
    EXPECT_NEAR(r.film.at(5, 5).w, d, 1e-6);
}

TEST(Atmosphere, WithoutAFarClipTheFogEndsBehindTheScene) {
    SceneText scene = fog_scene();
    scene.cameras =
        "<camera id=\"eye\"><optics><technique_common><orthographic><xmag>2</xmag>"
        "</orthographic></technique_common></optics></camera>";
    scene.square("floor", 1).look("floor-look", plain({1, 1, 1})).place("floor", "floor-look");
    Rendering r(scene.text());
    r.frame();
    double length = 10 + std::sqrt(8.0);  // to the scene's centre, and its diagonal
    expect_near(r.color(0, 0), fogged({0, 0, 0}, length), 1e-5);
}

TEST(Atmosphere, ABackgroundIsSeenThroughTheFog) {
    Rendering r(fog_scene().text());
    r.settings.integrator.background = vec3(1, 0, 0);
    r.frame();
    expect_near(r.color(5, 5), fogged({1, 0, 0}, 100));
}

TEST(Atmosphere, LayersAreFoggedOnTheirOwnPartOfTheWay) {
    SceneText scene = fog_scene();
    scene.square("floor", 1.5)
        .look("glass", plain({0.2, 0.6, 1}, 0.5))
        .look("wall", plain({1, 0.5, 0}))
        .place("floor", "glass", "<translate>0 0 3</translate>")
        .place("floor", "wall");
    Rendering r(scene.text());
    r.frame();
    double through = std::exp(-7.0 / 7);
    dvec3 front = fogged(dvec3(0.2, 0.6, 1) * 0.5, 7);
    dvec3 behind = fogged({1, 0.5, 0}, 3);
    expect_near(r.color(8, 8), front + 0.5 * through * behind);
}

TEST(Atmosphere, IsSeenInMirrorsAlongTheReflectedRay) {
    SceneText scene = fog_scene();
    scene.square("floor", 1.5)
        .square("sky", 50)
        .look("mirror", "surface m() { Oi = 1; Ci = trace(P, vector \"world\" (0, 0, 1)); }")
        .look("wall", plain({1, 0.5, 0}))
        .place("floor", "mirror")
        .place("sky", "wall", "<translate>0 0 20</translate>");
    Rendering r(scene.text());
    r.frame();
    expect_near(r.color(8, 8), fogged(fogged({1, 0.5, 0}, 20), 10), 4e-6);
}

TEST(Atmosphere, OfTheCameraWinsOverTheScenes) {
    SceneText scene = fog_scene();
    scene.look("own", "volume v() { Ci = color(0, 1, 0); }", kVolume);
    size_t end = scene.cameras.find("</camera>");
    scene.cameras.insert(end, rsl_extra("<instance_effect url=\"#own-fx\"/>"));
    Rendering r(scene.text());
    expect_near(r.frame().color(5, 5), {0, 1, 0});
}

TEST(Atmosphere, SeveralVolumesOfAPassRunOneAfterTheOther) {
    SceneText scene;
    scene.scene_effect("two",
                       "volume first() { Ci += 0.25; Oi = 0.5; }"
                       "volume second() { Ci *= 0.5; Ci += 0.1 * Oi; }",
                       "<shader stage=\"VOLUME\"><name>first</name></shader>"
                       "<shader stage=\"VOLUME\"><name>second</name></shader>");
    Rendering r(scene.text());
    expect_near(r.frame().color(5, 5), dvec3(0.175));
    EXPECT_NEAR(r.film.at(5, 5).w, 0.5, 1e-6);
}

TEST(Atmosphere, TheStandardFogAndDepthcueAreTheirFormulas) {
    for (const char* name : {"fog", "depthcue"}) {
        SceneText scene;
        std::string include =
            fmt::format("#include \"{}/assets/shaders/{}.sl\"", project_folder(), name);
        scene.scene_effect("air", include, kVolume);
        scene.square("floor", 1.5).look("floor-look", plain({1, 0.5, 0}));
        scene.place("floor", "floor-look");
        Rendering r(scene.text());
        r.frame();
        bool fog = std::string(name) == "fog";
        double kept = fog ? std::exp(-10.0) : 1 - (10 - 0.1) / (100 - 0.1);
        expect_near(r.color(5, 5), dvec3(1, 0.5, 0) * kept);
    }
}

TEST(Smoke, MarchedThroughEvenDensityIsTheClosedForm) {
    SceneText scene;
    std::string include = fmt::format("#include \"{}/assets/shaders/smoke.sl\"", project_folder());
    scene.scene_effect("smoke", include,
                       "<shader stage=\"VOLUME\"><bind symbol=\"density\"><float>0.1</float></bind>"
                       "<bind symbol=\"stepsize\"><float>0.25</float></bind>"
                       "<bind symbol=\"scatter\"><float>0.5</float></bind></shader>");
    scene.square("floor", 1.5).look("floor-look", plain({1, 0.5, 0}));
    scene.place("floor", "floor-look")
        .light("sun", "<directional><color>0.5 1 2</color></directional>", "",
               rsl_extra("<shadows>0</shadows>"));
    Rendering r(scene.text());
    r.frame();
    double kept = std::exp(-0.1 * 10);
    expect_near(
        r.color(5, 5),
        dvec3(1, 0.5, 0) * kept + dvec3(2 * 0.0508760882, 2 * 0.2140411405, 2) * 0.5 * (1 - kept),
        1e-5);
}

// Light that a lamp scatters into an axis-parallel ray, as an integral in double precision.
TEST(Smoke, LightsAreAskedAtEveryMarchedPoint) {
    SceneText scene;
    scene.scene_effect("air",
                       "volume march() { float k; float n = 400; vector step = I / n;"
                       "  for (k = 0; k < n; k += 1) {"
                       "    point here = P - (k + 0.5) * step;"
                       "    illuminance (here) { Ci += Cl * length(step) * 0.1; } } }",
                       kVolume);
    scene.square("floor", 1.5).look("floor-look", plain({0, 0, 0})).place("floor", "floor-look");
    scene.light("lamp",
                "<point><color>1 0.5 2</color><constant_attenuation>0</constant_attenuation>"
                "<quadratic_attenuation>1</quadratic_attenuation></point>",
                "<translate>0.3 3 4</translate>");
    Rendering r(scene.text());
    r.frame();
    for (int y : {2, 8, 13}) {
        dvec2 p = r.place(4, y);
        double sum = 0;
        for (int k = 0; k < 10000; ++k) {
            double z = (k + 0.5) * 1e-3;
            double dx = p.x - 0.3, dy = p.y - 3, dz = z - 4;
            sum += 1e-3 / (dx * dx + dy * dy + dz * dz);
        }
        expect_near(r.color(4, y), dvec3(2 * 0.2140411405, 2 * 0.0508760882, 2) * 0.1 * sum, 2e-5);
    }
}

TEST(Interior, FillsItsObjectAndNothingElse) {
    SceneText scene;
    filled_cube(scene, "box", kFog, 0.5);
    Rendering r(scene.text());
    r.frame();
    double d = 1 - std::exp(-1.0 / 7);
    expect_near(r.color(8, 8), kBackground * d);
    EXPECT_NEAR(r.film.at(8, 8).w, d, 1e-6);
    EXPECT_EQ(r.film.at(1, 1), vec4(0));
}

TEST(Interior, ThingsWithinAreSeenThroughTheirPartOfIt) {
    SceneText scene;
    scene.square("sheet", 0.25).look("wall", plain({1, 0.5, 0}));
    filled_cube(scene, "box", kFog, 0.5).place("sheet", "wall", "<translate>0 0 0.2</translate>");
    Rendering r(scene.text());
    r.frame();
    expect_near(r.color(8, 8), fogged({1, 0.5, 0}, 0.3));
}

TEST(Interior, WithinAnotherEndsWhereItsObjectDoes) {
    SceneText scene;
    filled_cube(scene, "outer", kFog, 1);
    filled_cube(
        scene, "inner",
        "volume clear() { Ci = mix(Ci, color(1, 0, 0), 0.25); Oi = mix(Oi, color(1), 0.25); }", 0.5,
        "<translate>0 0 0.25</translate>");
    Rendering r(scene.text());
    r.frame();
    dvec3 far = fogged(dvec3(0), 0.75);
    dvec3 middle = far * 0.75 + dvec3(0.25, 0, 0);
    expect_near(r.color(8, 8), fogged(middle, 0.25));
}

TEST(Interior, ReplacesTheAtmosphereInside) {
    SceneText scene = fog_scene();
    scene.square("wall", 2).look("wall-look", plain({1, 0.5, 0})).place("wall", "wall-look");
    filled_cube(scene, "box", "volume clear() { }", 0.5, "<translate>0 0 4</translate>");
    Rendering r(scene.text());
    r.frame();
    expect_near(r.color(8, 8), fogged({1, 0.5, 0}, 9));
    expect_near(r.color(0, 0), fogged({1, 0.5, 0}, 10));
}

TEST(Interior, ShaderSpaceIsTheFilledObjects) {
    SceneText scene;
    scene.square("sheet", 0.25).look("wall", plain({0, 0, 0}));
    filled_cube(scene, "box",
                "volume where() { point p = transform(\"shader\", P);"
                "  Ci = color(xcomp(p), ycomp(p), zcomp(p)); Oi = 1; }",
                0.5, "<translate>-0.3 -0.4 0.25</translate>")
        .place("sheet", "wall", "<translate>0 0 0.125</translate>");
    Rendering r(scene.text());
    r.frame();
    dvec2 p = r.place(7, 9);
    expect_near(r.color(7, 9), {p.x + 0.3, p.y + 0.4, -0.125});
}

TEST(Interior, TakesFromShadowRaysWhatItTakesFromOthers) {
    SceneText scene;
    scene.square("floor", 2).look("matte", "surface m() { Oi = 1; Ci = diffuse(normalize(N)); }");
    scene.place("floor", "matte");
    // Wide in x and y, so that the floor is seen through it and lit through it.
    filled_cube(scene, "box", kFog, 1, "<translate>0 0 2</translate><scale>3 3 0.5</scale>");
    scene.light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering r(scene.text());
    r.frame();
    expect_near(r.color(8, 8), fogged(dvec3(std::exp(-1.0 / 7)), 1));
}

TEST(Interior, TakesFromTheLightOfALampInside) {
    SceneText scene;
    scene.square("sheet", 0.4).look("matte", "surface m() { Oi = 1; Ci = diffuse(normalize(N)); }");
    filled_cube(scene, "box", kFog, 0.9)
        .place("sheet", "matte")
        .light("lamp", "<point><color>1 1 1</color></point>", "<translate>0 0 0.5</translate>");
    Rendering r(scene.text());
    r.frame();
    dvec2 p = r.place(9, 6);
    double d = std::sqrt(p.x * p.x + p.y * p.y + 0.25);
    expect_near(r.color(9, 6), fogged(dvec3(0.5 / d * std::exp(-d / 7)), 0.9));
}

TEST(Interior, SmokeShadesItself) {
    SceneText scene;
    filled_cube(scene, "box",
                "volume march() { float k; float n = 256; vector step = I / n;"
                "  for (k = 0; k < n; k += 1) {"
                "    float keep = exp(-2 * length(step)); color light = 0;"
                "    illuminance (P - (k + 0.5) * step) { light += Cl; }"
                "    Ci = Ci * keep + (1 - keep) * light; Oi = Oi * keep + (1 - keep); } }",
                0.5);
    scene.light("sun", "<directional><color>1 1 1</color></directional>");  // along the view
    Rendering r(scene.text());
    r.frame();
    // Light and view go the same way: the integral of 2 exp(-2 z) exp(-2 z) over the depth of 1.
    expect_near(r.color(8, 8), dvec3(0.5 * (1 - std::exp(-4.0))), 1e-4);
}

// Asking for the lights at places of its own is bounded for a point, whatever the loop.
TEST(Interior, AMarchThatAsksForLightsTooOftenSaysSo) {
    for (int rounds : {100, 10000}) {
        SceneText scene;
        scene.square("floor", 2)
            .look("look", fmt::format("surface march() {{ float k; Oi = 1; Ci = 0;"
                                      " for (k = 0; k < {}; k += 1)"
                                      "   illuminance (P + k * 1e-4 * N) {{ Ci += 1; }} }}",
                                      rounds));
        scene.place("floor", "look")
            .light("sun", "<directional><color>1 1 1</color></directional>");
        Rendering r(scene.text());
        r.frame(2, 2);
        EXPECT_EQ(r.count("LIGHT_LIMIT"), rounds > int(kMostLightQuestions)) << r.findings();
        EXPECT_EQ(r.color(1, 1).x, float(std::min(rounds, int(kMostLightQuestions))));
    }
}

TEST(Exterior, SurroundsItsObjectUpToTheEye) {
    SceneText scene;
    scene.square("floor", 0.5)
        .look("hazy", plain({1, 0.5, 0}) + "\n" + kFog,
              std::string("<shader stage=\"SURFACE\"/>") + kVolume, "",
              "<extra><technique profile=\"RSL\" target=\"exterior\"/></extra>")
        .look("clear", plain({1, 0.5, 0}))
        .place("floor", "hazy", "<translate>-0.5 0 0</translate>")
        .place("floor", "clear", "<translate>0.5 0 0</translate>");
    Rendering r(scene.text());
    r.frame();
    expect_near(r.color(4, 8), fogged({1, 0.5, 0}, 10));
    expect_near(r.color(12, 8), {1, 0.5, 0});
}

// One material with both: what the view goes through within the box, and what before it.
TEST(Exterior, StandsBesideAnInterior) {
    auto haze = [](const char* name, const char* color) {
        return fmt::format("volume {}() {{ float d = length(I); Ci += {} * d; }}\n", name, color);
    };
    const char* stages =
        "<shader stage=\"SURFACE\"/><shader stage=\"VOLUME\"><name>within</name></shader>"
        "<shader stage=\"VOLUME\"><name>around</name></shader>";
    for (const char* extra :
         {"<extra><technique profile=\"RSL\" target=\"interior exterior\"/></extra>",
          "<extra><technique profile=\"RSL\"><volume target=\"interior\"/>"
          "<volume target=\"exterior\"/></technique></extra>"}) {
        SceneText scene;
        scene.look("black", "surface black() { Oi = 1; Ci = 0; }");
        scene.square("back", 5).place("back", "black", "<translate>0 0 -2</translate>");
        scene.look("glass",
                   "surface clear() { Oi = 0; Ci = 0; }\n" + haze("within", "color(1, 0, 0)") +
                       haze("around", "color(0, 1, 0)"),
                   stages, "", extra);
        scene.cube("box", 0.5).place("box", "glass");
        Rendering r(scene.text());
        r.frame();
        EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
        // The box is 1 deep; 9.5 lie before it and 1.5 behind.
        EXPECT_NEAR(r.color(8, 8).x, 1.0f, 1e-4f) << r.findings();
        EXPECT_NEAR(r.color(8, 8).y, 11.0f, 1e-4f);
    }
}

TEST(Volumes, GiveTheSameBytesForAnyThreadsAndTargets) {
    SceneText scene = fog_scene();
    std::string include = fmt::format("#include \"{}/assets/shaders/smoke.sl\"", project_folder());
    scene.octahedron("ball").look("matte", "surface m() { Oi = 1; Ci = diffuse(normalize(N)); }");
    scene.place("ball", "matte", "<scale>0.4 0.4 0.4</scale>");
    scene.cube("box", 0.8)
        .look("box-look", std::string(kEmpty) + "\n" + include,
              std::string("<shader stage=\"SURFACE\"/>") +
                  "<shader stage=\"VOLUME\"><bind symbol=\"frequency\"><float>3</float></bind>"
                  "<bind symbol=\"density\"><float>2</float></bind></shader>")
        .place("box", "box-look")
        .light("lamp", "<point><color>1 1 1</color></point>", "<translate>1 2 3</translate>");
    std::string text = scene.text();
    Rendering first(text);
    first.frame(40, 40);
    EXPECT_FALSE(first.diagnostics.has_errors()) << first.findings();
    for (int threads : {1, 3}) {
        Threads scope(threads);
        Rendering again(text);
        again.frame(40, 40);
        EXPECT_TRUE(same_bytes(first.film, again.film)) << threads << " threads";
    }
    for (const jit::Target& row : jit::targets()) {
        if (!row.supported()) continue;
        const jit::Target* target = &row;
        SceneOptions options;
        options.target = target;
        Rendering again(text, options);
        again.frame(40, 40);
        EXPECT_TRUE(same_bytes(first.film, again.film)) << target->name;
    }
}

TEST(Volumes, StagesWithoutSenseAreNamed) {
    SceneText scene;
    scene.scene_effect("s", plain({1, 1, 1}), "<shader stage=\"SURFACE\"/>");
    scene.square("floor").look("i", "imager i() { Ci = 1; } surface s() { }",
                               "<shader stage=\"SURFACE\"/><shader stage=\"IMAGER\"/>");
    scene.place("floor", "i");
    filled_cube(scene, "box", kFog, 1, "",
                "<extra><technique profile=\"RSL\" target=\"inside\"/></extra>");
    Rendering r(scene.text());
    EXPECT_EQ(r.count("RSL_STAGE_PLACE"), 2) << r.findings();
    EXPECT_EQ(r.count("RSL_VOLUME_TARGET"), 1) << r.findings();
}

TEST(Medium, EntersAndLeavesInAnyOrder) {
    uint32_t m = enter_volume(enter_volume(enter_volume(0, 5), 7), 1023);
    EXPECT_EQ(innermost(m), 1023u);
    EXPECT_EQ(innermost(leave_volume(m, 1023)), 7u);
    EXPECT_EQ(leave_volume(leave_volume(m, 7), 1023), 5u);
    EXPECT_EQ(leave_volume(m, 9), m);
    uint32_t deep = enter_volume(m, 2);  // 5 is forgotten
    EXPECT_EQ(leave_volume(leave_volume(leave_volume(deep, 2), 1023), 7), 0u);
}

TEST(Atmosphere, ReachesToTheFarPlaneAtTheCornersToo) {
    SceneText scene;
    scene.cameras =
        "<camera id=\"eye\"><optics><technique_common><perspective><xfov>90</xfov>"
        "<aspect_ratio>1</aspect_ratio><znear>0.1</znear><zfar>10</zfar></perspective>"
        "</technique_common></optics></camera>";
    scene.scene_effect("way", "volume way() { Ci = length(I); Oi = 1; }", kVolume);
    Rendering r(scene.text());
    r.frame();
    for (int y : {0, 5, 15})
        for (int x : {0, 8, 15}) {
            double right = (x + 0.5) / 8 - 1, up = (y + 0.5) / 8 - 1;
            expect_near(r.color(x, y), dvec3(10 * std::sqrt(1 + right * right + up * up)), 1e-4);
        }
}

}  // namespace
}  // namespace kinora
