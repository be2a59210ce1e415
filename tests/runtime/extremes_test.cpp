// tests/runtime/extremes_test.cpp: numerical extremes with a defined outcome (docs/numerics.md).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/picture/compare/errors.h"
#include "scene_text.h"

namespace kinora {
namespace {

// A ball over a floor under a slanting sun, seen in perspective; all below one node with
// `transforms`. Shaders use shader space, so that scale and place must not show.
SceneText ball_scene(const std::string& transforms, const std::string& ball_transforms = "") {
    SceneText scene;
    const std::string bind =
        "<bind_material><technique_common><instance_material symbol=\"skin\" target=\"#look\"/>"
        "</technique_common></bind_material>";
    scene
        .look("look",
              "surface s() { Oi = 1; normal n = faceforward(normalize(N), I);"
              " Ci = (0.3 + 0.7 * noise(3 * transform(\"shader\", P))) * diffuse(n) + 0.05; }")
        .octahedron("ball")
        .square("floor", 3);
    scene.cameras =
        "<camera id=\"eye\"><optics><technique_common><perspective><yfov>40</yfov>"
        "<znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>";
    scene.lights =
        "<light id=\"sun\"><technique_common><directional><color>1 1 1</color></directional>"
        "</technique_common></light><light id=\"bulb\"><technique_common><spot><color>.5 .5 .5"
        "</color><falloff_angle>120</falloff_angle></spot></technique_common></light>";
    scene.camera_node = fmt::format(
        "<node>{0}<node><lookat>3 2 5 0 0.2 0 0 1 0</lookat><instance_camera url=\"#eye\"/></node>"
        "<node><rotate>1 1 0 -40</rotate><instance_light url=\"#sun\"/></node>"
        "<node><translate>0 0 3</translate><instance_light url=\"#bulb\"/></node>"
        "<node>{1}<instance_geometry url=\"#ball\">{2}</instance_geometry></node>"
        "<node><translate>0 0 -1</translate><instance_geometry url=\"#floor\">{2}"
        "</instance_geometry></node></node>",
        transforms, ball_transforms, bind);
    return scene;
}

// Pixels at edges may go the other way by one rounding; the rest must agree.
void expect_same_picture(Rendering& a, Rendering& b, float tolerance, size_t edge_pixels) {
    a.frame(96, 72);
    b.frame(96, 72);
    EXPECT_LE(different_pixels(a.film, b.film, tolerance), edge_pixels)
        << difference(a.film, b.film) << "\n"
        << b.findings();
    EXPECT_GT(a.film.at(48, 36).w, 0.99f) << a.findings();
}

TEST(Extremes, ASceneFarFromItsOriginRendersLikeAtTheOrigin) {
    Rendering home(ball_scene("").text());
    for (const char* where : {"1e4 -1e4 1e4", "1e7 -1e7 1e7"}) {
        Rendering far(ball_scene(fmt::format("<translate>{}</translate>", where)).text());
        expect_same_picture(home, far, 2e-4f, 8);
    }
}

TEST(Extremes, VerticesFarFromTheOriginRenderLikeAtTheOrigin) {
    SceneText home, far;
    for (SceneText* scene : {&home, &far}) {
        double o = scene == &far ? 1e7 : 0;
        scene->look("look", "surface s() { Oi = 1; Ci = diffuse(normalize(N)); }");
        scene->mesh("m", {{o - 1, o, 0}, {o + 1, o - 0.5, 0.25}, {o, o + 0.75, -0.5}}, {0, 1, 2});
        scene->place("m", "look");
        scene->light("sun", "<directional><color>1 1 1</color></directional>");
        scene->camera_node = fmt::format(
            "<node><translate>{0} {0} 10</translate><instance_camera url=\"#eye\"/></node>", o);
    }
    Rendering a(home.text()), b(far.text());
    expect_same_picture(a, b, 1e-5f, 4);
}

TEST(Extremes, TheSizeOfTheSceneDoesNotShow) {
    Rendering home(ball_scene("").text());
    for (const char* scale : {"1e-6", "1e6"}) {
        Rendering other(ball_scene(fmt::format("<scale>{0} {0} {0}</scale>", scale)).text());
        expect_same_picture(home, other, 2e-4f, 8);
    }
}

TEST(Extremes, TheUnitDoesNotShow) {
    Rendering home(ball_scene("").text());
    home.frame(48, 36);
    for (const char* meter : {"1e-6", "1e9"}) {
        SceneText scene = ball_scene("");
        scene.asset = fmt::format("<unit name=\"x\" meter=\"{}\"/><up_axis>Y_UP</up_axis>", meter);
        Rendering other(scene.text());
        EXPECT_TRUE(same_bytes(home.film, other.frame(48, 36).film)) << meter;
    }
}

// ---- far and small, as a viewer sees it

// Mean FLIP under 0.01, and at most 0.2 % of the pixels off by more than one step of 8 bits.
void expect_looks_the_same(const raytrace::Film& picture, const raytrace::Film& home,
                           const std::string& where) {
    ASSERT_EQ(picture.rgba.size(), home.rgba.size());
    auto view = [](const raytrace::Film& film) {
        return PictureView{film.width, film.height, film.rgba};
    };
    EXPECT_LT(picture_errors(view(picture), view(home)).flip, 0.01) << where;
    size_t off = 0;
    auto step = [](float linear) { return std::lround(255 * encode_srgb(double(linear))); };
    for (size_t i = 0; i < home.rgba.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (std::abs(step(picture.rgba[i][k]) - step(home.rgba[i][k])) > 1) {
                ++off;
                break;
            }
    EXPECT_LE(off, home.rgba.size() / 500) << where;
}

TEST(FarAndSmall, ThePictureStays) {
    Rendering home(ball_scene("").text());
    home.settings.integrator.samples_per_pixel = 4;
    home.frame(160, 120);
    std::vector<std::string> places;
    for (const char* d : {"1e3", "1e5", "1e7"})
        places.push_back(fmt::format("<translate>{0} -{0} {0}</translate>", d));
    for (const char* s : {"1e-6", "1e6"})
        places.push_back(fmt::format("<scale>{0} {0} {0}</scale>", s));
    for (const std::string& place : places) {
        Rendering other(ball_scene(place).text());
        other.settings.integrator.samples_per_pixel = 4;
        other.frame(160, 120);
        expect_looks_the_same(other.film, home.film, place);
    }
}

// The z of each pixel tells where the surface is: from frame to frame the scene far away must move
// as the one at the origin does, within a thousandth of a pixel's size.
TEST(FarAndSmall, AnimationDoesNotJitter) {
    auto moving = [](double distance) {
        SceneText scene;
        scene.look("look",
                   "surface s(output varying float depth = 0;) { Oi = 1;"
                   " point p = transform(\"camera\", P); depth = zcomp(p);"
                   " Ci = color(xcomp(p), ycomp(p), zcomp(p)); }");
        scene.octahedron("ball");
        scene.place("ball", "look", "<translate sid=\"t\">0 0 0</translate>", "mover");
        scene.animate("mover/t.X", {0, 1}, {0, 0.25});
        const std::string at = fmt::format("<translate>{0} {0} {0}</translate>", distance);
        scene.nodes = fmt::format("<node>{}{}</node>", at, scene.nodes);
        scene.camera_node = fmt::format("<node>{}{}</node>", at, scene.camera_node);
        return scene.text();
    };
    Rendering home(moving(0)), far(moving(1e7));
    const float pixel = 2.0f / 64;  // the camera shows two units
    for (double time : {0.0, 0.1, 0.11, 0.12, 0.5, 0.9}) {
        home.frame(64, 64, time);
        far.frame(64, 64, time);
        ASSERT_GT(home.film.at(32, 32).w, 0.99f) << home.findings();
        EXPECT_LE(different_pixels(home.film, far.film, 1e-3f * pixel), 4u)
            << time << ": " << difference(home.film, far.film);
    }
}

// ---- skins

// Pixels covered in the row that shows y.
int width_at(const raytrace::Film& film, double y) {
    const int row = std::min(film.height - 1, int((1 - y) / 2 * film.height));
    int covered = 0;
    for (int x = 0; x < film.width; ++x) covered += film.at(x, row).w > 0.5f;
    return covered;
}

// A strip of half width 0.3 along y whose upper half is turned by a quarter about y. Where both
// joints have half of a vertex, linear blending shows 0.3 / 2, and an eighth of a turn 0.3 cos 45.
SceneText twisted_strip() {
    SceneText scene;
    scene.look("look", "surface s() { Oi = 1; Ci = 1; }");
    scene.bending_strip("limb", "look", 64);
    auto replace = [](std::string& text, std::string_view from, std::string_view to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace(scene.nodes, "<rotate sid=\"turn\">0 0 1 0</rotate>",
            "<rotate sid=\"turn\">0 1 0 0</rotate>");
    replace(scene.animations, "80", "90");
    return scene;
}

TEST(SkinMethods, LinearBlendsMatricesAndDualTurns) {
    for (SkinMethod method : {SkinMethod::Linear, SkinMethod::Dual}) {
        SceneOptions options;
        options.quality.skin_method = method;
        Rendering r(twisted_strip().text(), options);
        r.frame(400, 400, 1);
        const double half = method == SkinMethod::Linear ? 0.3 / 2 : 0.3 * std::cos(radians(45));
        EXPECT_NEAR(width_at(r.film, 0), 400 * half, 4) << r.findings();
        EXPECT_NEAR(width_at(r.film, -0.9), 400 * 0.3, 2);
        r.frame(400, 400, 0);
        EXPECT_NEAR(width_at(r.film, 0), 400 * 0.3, 2);
    }
}

TEST(SkinMethods, FewerInfluencesAreTold) {
    SceneOptions options;
    options.quality.influences = 1;
    Rendering r(twisted_strip().text(), options);
    r.frame(400, 400, 1);
    EXPECT_EQ(r.count("SKIN_INFLUENCES_DROPPED"), 1) << r.findings();
    EXPECT_NEAR(width_at(r.film, -0.1), 400 * 0.3, 2);  // of the lower joint alone
    EXPECT_LE(width_at(r.film, 0.1), 4);                // of the upper one: edge on
}

// ---- normals as given

TEST(Extremes, ANormalAgainstItsFaceIsKept) {
    SceneText scene;
    scene.look("look",
               "surface s() { Oi = 1; normal n = ntransform(\"world\", N);"
               " Ci = color(0.5 + 0.5 * xcomp(n), 0.5 + 0.5 * ycomp(n), 0.5 + 0.5 * zcomp(n)); }");
    const dvec3 back(0, 0, -1);
    scene.mesh("m", {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {0, 1, 2}, {back, back, back});
    scene.place("m", "look");
    Rendering r(scene.text());
    r.frame();
    EXPECT_NEAR(r.color(8, 8).z, 0, 1e-6) << r.findings();
    EXPECT_NEAR(r.color(8, 8).x, 0.5, 1e-6);
}

// ---- matrices without inverse, and mirrors

SceneText two_squares(const std::string& transforms) {
    SceneText scene;
    scene.square("s", 0.4)
        .look("l", "surface s() { Oi = 1; Ci = 1; }")
        .place("s", "l", transforms, "flat")
        .place("s", "l", "<translate>0.5 0 0</translate>");
    return scene;
}

TEST(Extremes, AScaleOfZeroDropsTheNodeAndSaysSoOnce) {
    SceneText still = two_squares("<scale>1 0 1</scale>");
    SceneText moving = two_squares("<scale>1 0 1</scale><rotate sid=\"r\">0 0 1 0</rotate>");
    moving.animate("flat/r.ANGLE", {0, 1}, {0, 90});
    for (const SceneText* scene : {&still, &moving}) {
        Rendering r(scene->text());
        r.frame(0);
        r.frame(0.5);
        EXPECT_EQ(r.count("NODE_SINGULAR"), 1) << r.findings();
        EXPECT_EQ(r.film.at(2, 8).w, 0.0f);
        EXPECT_EQ(r.film.at(12, 8).w, 1.0f);
    }
}

TEST(Extremes, AScaleThatPassesThroughZeroComesBack) {
    SceneText scene = two_squares("<translate>-0.5 0 0</translate><scale sid=\"s\">1 1 1</scale>");
    scene.animate("flat/s.X", {0, 1, 2}, {1, 0, 1});
    Rendering r(scene.text());
    EXPECT_EQ(r.frame(0).film.at(4, 8).w, 1.0f);
    EXPECT_EQ(r.frame(1).film.at(4, 8).w, 0.0f);
    EXPECT_EQ(r.frame(2).film.at(4, 8).w, 1.0f) << r.findings();
    EXPECT_EQ(r.film.at(12, 8).w, 1.0f);
}

TEST(Extremes, AMirroredNodeIsRightSideOut) {
    SceneText still, moving;
    for (SceneText* scene : {&still, &moving})
        scene->octahedron("ball")
            .look("l",
                  "surface s() { Oi = 1; vector V = -normalize(I);"
                  " Ci = color(normalize(N) . normalize(Ng), normalize(Ng) . V,"
                  "            normalize(calculatenormal(P)) . V); }")
            .place("ball", "l", "<scale>-0.9 0.9 0.9</scale><rotate sid=\"r\">1 1 0 25</rotate>",
                   "ball-node");
    moving.animate("ball-node/r.ANGLE", {0, 1}, {25, 60});
    for (const SceneText* scene : {&still, &moving}) {
        Rendering r(scene->text());
        r.frame();
        int covered = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                if (r.film.at(x, y).w == 0) continue;
                ++covered;
                EXPECT_GT(r.color(x, y).x, 0.0f) << x << "," << y << r.findings();
                EXPECT_GT(r.color(x, y).y, 0.0f) << x << "," << y;
                EXPECT_NEAR(r.color(x, y).z, r.color(x, y).y, 1e-4) << x << "," << y;
            }
        EXPECT_GT(covered, 60);
    }
}

TEST(Extremes, NormalsSurviveScalesOf1e10InOneAxis) {
    SceneText scene;
    scene.square("s")
        .look("l",
              "surface s() { Oi = 1; vector n = ntransform(\"world\", normalize(N));"
              " Ci = color(xcomp(n), ycomp(n), zcomp(n)); }")
        .place("s", "l", "<scale>1 1 1e-10</scale>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_NEAR(r.color(8, 8).z, 1, 1e-6) << r.findings();
}

TEST(Extremes, ZeroNormalsGiveWayToTheGeometricOnes) {
    SceneText scene;
    scene
        .mesh("m", {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}, {0, 1, 2},
              std::vector<dvec3>(3, dvec3(0)))
        .look("l",
              "surface s() { Oi = 1; vector n = ntransform(\"world\", N);"
              " Ci = color(xcomp(n), ycomp(n), zcomp(n)); }")
        .place("m", "l");
    Rendering r(scene.text());
    vec3 c = r.frame().color(8, 8);
    EXPECT_NEAR(c.z, 1, 1e-6) << r.findings();
}

TEST(Extremes, DegenerateTrianglesAreNeverHitAndHarmNothing) {
    SceneText scene;
    scene
        .mesh("m", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0}},
              {0, 1, 2, 0, 2, 3, 0, 0, 1, 1, 4, 3, 2, 2, 2})
        .look("l", "surface s() { Oi = 1; Ci = 0.5 + 0 * N . N; }")
        .place("m", "l");
    Rendering r(scene.text());
    r.frame();
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(r.color(x, y).x, 0.5f) << x << "," << y;
    EXPECT_EQ(r.stats.non_finite, 0u) << r.findings();
}

// ---- shaders

TEST(Extremes, NonFiniteResultsAreWrittenAsZeroAndNamed) {
    SceneText scene;
    scene.square("s", 2)
        .look("broken",
              "surface s() { Oi = 1; float big = (s + 1) * 1e38; big *= big; Ci = big - big; }")
        .place("s", "broken");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.color(8, 8), vec3(0.0f));
    ASSERT_EQ(r.count("SHADER_NON_FINITE"), 1) << r.findings();
    EXPECT_NE(r.find("SHADER_NON_FINITE")->message.find("broken"), std::string::npos);
    EXPECT_EQ(r.stats.non_finite, 256u);
}

TEST(Extremes, ALoopWithoutEndEndsWithAFindingAtItsPlace) {
    SceneText scene;
    scene.square("s", 2)
        .look("endless",
              "surface s() { Oi = 1; float k = s, n = 0;\n"
              "  while (k < 2) { k = mod(k + 0.25, 1); n += 1; }\n Ci = n / 1e6; }")
        .place("s", "endless");
    Rendering r(scene.text());
    r.frame(4, 4);
    ASSERT_EQ(r.count("SHADER_FAULT"), 1) << r.findings();
    const Finding& finding = *r.find("SHADER_FAULT");
    LineColumn at = r.where(finding);
    std::string_view line = r.diagnostics.files.line_text(finding.where.file, at.line);
    EXPECT_NE(line.find("while"), std::string_view::npos) << r.findings();
    EXPECT_NEAR(r.color(2, 2).x, 1, 1e-5);  // the budget: a million
}

TEST(Extremes, ArrayIndicesClampWithAFinding) {
    SceneText scene;
    scene.square("s", 2)
        .look("l",
              "surface s() { Oi = 1; float a[3] = {0.25, 0.5, 0.75}; float i = 100 * (s + 1);"
              " Ci = color(a[i], a[-i], 0); }")
        .place("s", "l");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.color(8, 8), vec3(0.75f, 0.25f, 0.0f)) << r.findings();
}

TEST(Extremes, ALightAtTheShadedPointIsFinite) {
    SceneText scene;
    scene.square("s", 1)
        .look("l", "surface s() { Oi = 1; Ci = diffuse(normalize(N)); }")
        .place("s", "l")
        .light("bulb",
               "<point><color>1 1 1</color><constant_attenuation>0</constant_attenuation>"
               "<quadratic_attenuation>1</quadratic_attenuation></point>",
               "<translate>0 0 0</translate>");
    Rendering r(scene.text());
    r.frame(1, 1);
    EXPECT_EQ(r.stats.non_finite, 0u) << r.findings();
    EXPECT_TRUE(std::isfinite(r.color(0, 0).x));
}

}  // namespace
}  // namespace kinora
