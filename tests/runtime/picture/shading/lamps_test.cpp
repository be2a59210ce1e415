// tests/runtime/picture/shading/lamps_test.cpp: light of lamps on geometry counts once.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/ray_scenes.h"

namespace kinora {
namespace {

// A lamp of radiance 12 and area 4, one-sided.
const char* kPanel =
    "light panel() { illuminate(P, N, PI/2)"
    " Cl = 12 * 4 / PI * (normalize(L) . normalize(N)) / (L . L); }";
const char* kPanelGlow = "surface glow() { Oi = 1; Ci = 12; }";
constexpr double kPanelHalf = 1, kPanelAt = 2;

// Form factor of a rectangle [0,x] x [0,y] at distance 1, parallel to a differential element under
// its corner (Howell, A catalog of radiation configuration factors, B-4).
double corner_share(double x, double y) {
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * kPi);
}
double panel_share(dvec2 p) {
    auto corner = [&](double x, double y) {
        return std::copysign(corner_share(std::abs(x) / kPanelAt, std::abs(y) / kPanelAt), x * y);
    };
    return corner(kPanelHalf - p.x, kPanelHalf - p.y) + corner(kPanelHalf + p.x, kPanelHalf - p.y) +
           corner(kPanelHalf - p.x, kPanelHalf + p.y) + corner(kPanelHalf + p.x, kPanelHalf + p.y);
}

// A floor under the lamp, which looks down on it and is not in the camera's way.
SceneText under_lamp(const std::string& floor, const std::string& surface) {
    SceneText scene = floor_scene(floor);
    scene.camera_node =
        "<node id=\"eye-node\"><translate>0 0 1.5</translate>"
        "<instance_camera url=\"#eye\"/></node>";
    const std::string passes = surface.empty() ? "<shader stage=\"LIGHT\"/>"
                                               : "<shader stage=\"LIGHT\"/><shader "
                                                 "stage=\"SURFACE\"/>";
    scene.square("lamp", kPanelHalf).look("lamp-look", kPanel + surface, passes);
    return scene.place(
        "lamp", "lamp-look",
        fmt::format("<translate>0 0 {}</translate><rotate>1 0 0 180</rotate>", kPanelAt));
}

double ratio_to_truth(const SceneText& scene) {
    SceneOptions options;
    options.quality.light_samples = 64;
    Rendering r(scene.text(), options);
    r.settings.integrator.samples_per_pixel = 16;
    r.frame(16, 16);
    EXPECT_EQ(r.findings(), "");
    double got = 0, want = 0;
    for (int k = 0; k < 256; ++k) {
        got += double(r.color(k % 16, k / 16).x);
        want += 12 * panel_share(r.place(k % 16, k / 16));
    }
    return got / want;
}

std::string gathered(const char* angle) {
    return std::string("color c = 0, sum = 0; gather(\"illuminance\", P, n, ") + angle +
           ", 64, \"distribution\", \"cosine\", \"surface:Ci\", c) sum += c / 64;";
}

// Direct light and rays that meet the lamp: each of the two alone, and both, are one lamp.
TEST(Lamps, LightCountsOnce) {
    const std::string direct = "diffuse(n)", bounced = "indirectdiffuse(P, n, 64)";
    for (const char* surface : {"", kPanelGlow}) {
        for (const std::string& sum : {direct, bounced, direct + " + " + bounced}) {
            SCOPED_TRACE(sum + surface);
            EXPECT_NEAR(ratio_to_truth(under_lamp(floor_code("Ci = " + sum + ";"), surface)), 1,
                        0.005);
        }
        for (const char* ends : {"sum", "sum + diffuse(n)"}) {
            SCOPED_TRACE(std::string(ends) + surface);
            const std::string body = gathered("PI/2") + " Ci = " + ends + ";";
            EXPECT_NEAR(ratio_to_truth(under_lamp(floor_code(body), surface)), 1, 0.005);
        }
    }
}

// What a lamp reflects is seen beside its own light: here a quarter as much, from a second lamp
// that the floor does not look at. Mirrors show all of it.
TEST(Lamps, ReflectLightToo) {
    const std::string grey =
        "surface grey() { Oi = 1; Ci = 12; illuminance(\"other\", P) Ci += 3 * Cl; }";
    SceneText scene =
        under_lamp(floor_code("illuminance(\"-other\", P, n, PI / 2) Ci += Cl * (normalize(L) . n);"
                              " Ci += indirectdiffuse(P, n, 64);"),
                   grey);
    scene.rsl_light("other",
                    "light other(string __category = \"other\";) {"
                    " illuminate(point \"world\" (0, 0, 0.5)) Cl = 1; }");
    EXPECT_NEAR(ratio_to_truth(scene), 1.25, 0.006);
    for (const char* surface : {"", kPanelGlow}) {
        Rendering mirror(under_lamp(floor_code("Ci = diffuse(n) + trace(P, up);"), surface).text());
        Rendering plain(under_lamp(floor_code("Ci = diffuse(n);"), surface).text());
        mirror.frame();
        plain.frame();
        EXPECT_NEAR(mirror.color(8, 8).x - plain.color(8, 8).x, 12, 1e-3);
    }
}

// A lamp that does not light the floor by itself is seen by its rays.
TEST(Lamps, ThatLightNothingThemselvesAreSeenByRays) {
    SceneText scene = under_lamp(
        floor_code("illuminance(\"none\", P) Ci += Cl; Ci += indirectdiffuse(P, n, 64);"),
        kPanelGlow);
    EXPECT_NEAR(ratio_to_truth(scene), 1, 0.005);
}

// Without a surface of its own a lamp shines where its shader sends light, whatever parameters it
// has: front and back, near and far.
TEST(Lamps, AreSeenAsTheyShine) {
    SceneText scene;
    scene.square("lamp", kPanelHalf).look("lamp-look", kPanel, "<shader stage=\"LIGHT\"/>");
    scene.place("lamp", "lamp-look",
                "<translate>-0.5 0 0</translate><rotate>0 1 0 50</rotate>"
                "<scale>0.5 0.5 1</scale>");
    scene.place("lamp", "lamp-look",
                "<translate>0.5 0 0</translate><rotate>0 1 0 180</rotate>"
                "<scale>0.4 0.4 1</scale>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.findings(), "");
    EXPECT_NEAR(r.color(4, 8).x, 12 / 0.25, 1e-3);  // a quarter of the area sends as much
    EXPECT_EQ(r.color(12, 8).x, 0.0f);
}

// In a box of many bounces, direct light and b bounces are the same paths as b + 1 bounces of rays
// that meet a surface which shines on one side.
TEST(Lamps, InABoxOfManyBouncesGiveTheSameAsRaysAlone) {
    auto mean = [](const std::string& lamp, const char* stage, const std::string& sum,
                   uint32_t bounces) {
        SceneText scene;
        add_box(scene,
                "surface wall() { Oi = 1; normal n = faceforward(normalize(N), I);"
                " Ci = 0.5 * (" +
                    sum + "); }",
                4);
        scene.camera_node =
            "<node id=\"eye-node\"><translate>0 0 3.5</translate>"
            "<instance_camera url=\"#eye\"/></node>";
        scene.square("lamp", 2 * kPanelHalf)
            .look("lamp-look", lamp, fmt::format("<shader stage=\"{}\"/>", stage))
            .place("lamp", "lamp-look", "<translate>0 0 3.8</translate><rotate>1 0 0 180</rotate>");
        SceneOptions options;
        options.quality.diffuse_depth = bounces;
        options.quality.light_samples = 4;
        Rendering r(scene.text(), options);
        r.settings.integrator.samples_per_pixel = 512;
        r.frame(16, 16);
        EXPECT_EQ(r.findings(), "");
        double all = 0;
        for (int k = 0; k < 256; ++k) all += double(r.color(k % 16, k / 16).x) / 256;
        return all;
    };
    const double lamp = mean(kPanel, "LIGHT", "diffuse(n) + indirectdiffuse(P, n, 1)", 3);
    const double rays = mean("surface glow() { Oi = 1; Ci = I . N < 0 ? color(3) : color(0); }",
                             "SURFACE", "indirectdiffuse(P, n, 1)", 4);
    EXPECT_NEAR(lamp / rays, 1, 0.01);
}

}  // namespace
}  // namespace kinora
