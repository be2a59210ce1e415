// tests/runtime/defaults_test.cpp: the lights of scenes that bring none (cameras:
// cameras_test.cpp).
#include "runtime/scene/build/defaults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene_text.h"

namespace kinora {
namespace {

SceneText bare_scene(const char* up, const std::string& transforms = "") {
    SceneText scene;
    scene.cameras = scene.camera_node = "";
    scene.asset = std::string("<unit name=\"meter\" meter=\"1\"/><up_axis>") + up + "</up_axis>";
    scene.octahedron("ball")
        .look("l", "surface s() { Oi = 1; Ci = 0.25 + 0.5 * diffuse(normalize(N)); }")
        .place("ball", "l", transforms);
    return scene;
}

bool added(const Rendering& r, const char* what) {
    const auto& list = r.scene->added;
    return std::find(list.begin(), list.end(), what) != list.end();
}

const char* const kLightNames[] = {"default key light", "default fill light", "default rim light"};

TEST(DefaultLights, ComeWhereThereIsNoneOrAmbientAlone) {
    SceneText scene = bare_scene("Y_UP");
    Rendering none(scene.text());
    scene.light("sky", "<ambient><color>1 1 1</color></ambient>");
    Rendering ambient(scene.text());
    scene.light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering lit(scene.text());
    for (const char* name : kLightNames) {
        EXPECT_TRUE(added(none, name)) << name;
        EXPECT_TRUE(added(ambient, name)) << name;
        EXPECT_FALSE(added(lit, name)) << name;
    }
    EXPECT_EQ(none.scene->lights.size(), 3u);
    EXPECT_EQ(ambient.scene->lights.size(), 4u);
}

// ---- how much light arrives: by hand, with the directions in the camera's space (z to the eye)

const dvec3 kKey(-std::sin(radians(35)) * std::cos(radians(35)), std::sin(radians(35)),
                 std::cos(radians(35)) * std::cos(radians(35)));
const dvec3 kFill = glm::normalize(dvec3(0.51, -0.26, 0.82));
const dvec3 kRim = glm::normalize(dvec3(0.37, 0.67, -0.64));

double cosine(dvec3 n, dvec3 from) {
    return std::max(0.0, glm::dot(n, from));
}
double fill_and_rim(dvec3 n) {
    return 0.22 * 0.5 * (1 + glm::dot(n, kFill)) + 0.35 * cosine(n, kRim);
}
double all_three(dvec3 n) {
    return 0.85 * cosine(n, kKey) + fill_and_rim(n);
}

// A white square before the camera of SceneText, turned about x and then about y.
SceneText white_square(const std::string& code, double x_degrees = 0, double y_degrees = 0) {
    SceneText scene;
    scene.square("wall", 3).look("l", code).place("wall", "l",
                                                  "<rotate>0 1 0 " + std::to_string(y_degrees) +
                                                      "</rotate><rotate>1 0 0 " +
                                                      std::to_string(x_degrees) + "</rotate>");
    return scene;
}
const char* kWhite = "surface s() { Oi = 1; Ci = diffuse(faceforward(normalize(N), I)); }";

TEST(DefaultLights, GiveTheSumOfTheThreeToBothSidesOfAPlane) {
    for (double x : {-75, -30, 0, 45, 80})
        for (double y : {-80, -20, 0, 60}) {
            double a = radians(x), b = radians(y);
            dvec3 n(std::cos(a) * std::sin(b), -std::sin(a), std::cos(a) * std::cos(b));
            for (double turn : {0.0, 180.0}) {  // its front, its back
                Rendering r(white_square(kWhite, turn == 0 ? x : -x, y + turn).text());
                EXPECT_NEAR(r.frame().color(8, 8).x, all_three(n), 1e-4)
                    << x << " " << y << " " << turn << r.findings();
            }
        }
}

TEST(DefaultLights, OnlyTheKeyLightCastsShadows) {
    SceneText scene = white_square(kWhite);
    // The key light's way to the middle of the picture leads through this plate, out of sight.
    dvec3 at = 2 / kKey.z * kKey;
    scene.square("plate", 0.3)
        .place("plate", "l", "<translate>" + numbers(std::vector<dvec3>{at}) + "</translate>");
    Rendering r(scene.text());
    EXPECT_NEAR(r.frame(15, 15).color(7, 7).x, fill_and_rim({0, 0, 1}), 1e-5);
    EXPECT_NEAR(r.color(0, 14).x, all_three({0, 0, 1}), 1e-4);
    // Fill and rim are also without shadows where a light of the scene would cast them.
    scene.place("plate", "l",
                "<translate>" + numbers(std::vector<dvec3>{2 / kFill.z * kFill}) + "</translate>");
    EXPECT_NEAR(Rendering(scene.text()).frame(15, 15).color(7, 7).x, fill_and_rim({0, 0, 1}), 1e-5);
}

TEST(DefaultLights, OnlyTheKeyLightMakesHighlights) {
    const char* highlights =
        "surface s() { Oi = 1; normal n = normalize(N);"
        " Ci = color(0); illuminance(P, n, PI) { float dull = 0;"
        " lightsource(\"__nonspecular\", dull); Ci += 1 - dull; }"
        " Ci *= color(1, 0, 0); Ci += color(0, 1, 1) * phong(n, -normalize(I), 0); }";
    Rendering r(white_square(highlights).text());
    vec3 c = r.frame().color(8, 8);
    EXPECT_FLOAT_EQ(c.x, 1);       // one of them
    EXPECT_NEAR(c.y, 0.85, 1e-5);  // pow(x, 0) of the key light alone
}

// A sphere of 48 by 24 with normals.
SceneText& add_sphere(SceneText& scene, const std::string& id) {
    constexpr int kAround = 48, kUp = 24;
    std::vector<dvec3> p;
    std::vector<int> triangles;
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i <= kAround; ++i) {
            double u = 2 * kPi * i / kAround, v = kPi * j / kUp;
            p.emplace_back(std::sin(v) * std::sin(u), std::cos(v), std::sin(v) * std::cos(u));
        }
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            int a = j * (kAround + 1) + i, b = a + kAround + 1;
            triangles.insert(triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    return scene.mesh(id, p, triangles, p);
}

std::vector<float> covered_levels(const raytrace::Film& film) {
    std::vector<float> levels;
    for (const vec4& p : film.rgba)
        if (p.w == 1) levels.push_back(p.x);
    std::sort(levels.begin(), levels.end());
    return levels;
}

TEST(DefaultLights, GiveAWhiteSphereFormWithoutBurningIt) {
    for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
        SceneText scene = bare_scene(up);
        scene.geometries = scene.nodes = scene.effects = scene.materials = "";
        add_sphere(scene, "ball").look("white", kWhite).place("ball", "white");
        Rendering r(scene.text());
        r.frame(64, 64);
        std::vector<float> levels = covered_levels(r.film);
        ASSERT_GT(levels.size(), 500u) << r.findings();
        size_t tenth = levels.size() / 10;
        double dark = 0, bright = 0;
        for (size_t i = 0; i < tenth; ++i) {
            dark += levels[i] / double(tenth);
            bright += levels[levels.size() - 1 - i] / double(tenth);
        }
        EXPECT_GE(bright / dark, 4) << up;
        EXPECT_GT(dark, 0.03) << up;
        EXPECT_LE(levels.back(), 1) << up;
    }
}

// All of it is in the key light's shadow.
TEST(DefaultLights, LeaveTheInsideOfAClosedRoomVisible) {
    SceneText scene;
    scene.cameras = R"(<camera id="eye"><optics><technique_common><perspective><yfov>70</yfov>
        <aspect_ratio>1</aspect_ratio><znear>0.01</znear><zfar>100</zfar></perspective>
        </technique_common></optics></camera>)";
    scene.camera_node = R"(<node id="eye-node"><translate>0 0 0.9</translate>
        <instance_camera url="#eye"/></node>)";
    scene.square("wall").look(
        "grey", "surface s() { Oi = 1; Ci = 0.5 * diffuse(faceforward(normalize(N), I)); }");
    for (const char* turn :
         {"0 1 0 0", "0 1 0 90", "0 1 0 180", "0 1 0 270", "1 0 0 90", "1 0 0 270"})
        scene.place("wall", "grey",
                    std::string("<rotate>") + turn + "</rotate><translate>0 0 -1</translate>");
    Rendering r(scene.text());
    r.frame(48, 48);
    std::vector<float> levels = covered_levels(r.film);
    ASSERT_EQ(levels.size(), 48u * 48u) << r.findings();
    constexpr float kSrgb43 = 0.0242f;
    auto lit = std::lower_bound(levels.begin(), levels.end(), kSrgb43);
    EXPECT_LT(lit - levels.begin(), ptrdiff_t(levels.size()) / 10);
    EXPECT_LT(levels.back(), 0.5 * 0.22 + 0.5 * 0.35);  // no light of the key's
}

TEST(DefaultLights, AreLeftOutWhereEverySurfaceIsConstant) {
    SceneText scene = bare_scene("Y_UP");
    scene.effects =
        "<effect id=\"l-fx\"><profile_COMMON><technique sid=\"t\"><constant><emission><color>0.5 "
        "0.25 1 1</color></emission></constant></technique></profile_COMMON></effect>";
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    EXPECT_TRUE(r.scene->lights.empty());
    vec3 c = r.frame(15, 15).color(7, 7);
    EXPECT_FLOAT_EQ(c.x, 0.2140411405f);  // ((0.5 + 0.055) / 1.055) ^ 2.4
    EXPECT_FLOAT_EQ(c.y, 0.0508760882f);
}

TEST(DefaultLights, TheKeyLightShinesFromOverTheCamerasLeftShoulder) {
    SceneText scene = bare_scene("Y_UP");
    scene.effects = scene.materials = "";
    // Shows the light's direction from the surface in camera space.
    scene.look("l",
               "surface s() { Oi = 1; Ci = 0; illuminance(P, -I, PI) {"
               " float dull = 0; lightsource(\"__nonspecular\", dull); vector d = normalize(L);"
               " if (dull == 0) Ci = color(xcomp(d), ycomp(d), zcomp(d)); } }");
    Rendering r(scene.text());
    vec3 c = r.frame(15, 15).color(7, 7);
    EXPECT_LT(c.x, -0.2f) << r.findings();  // left
    EXPECT_GT(c.y, 0.2f);                   // up
    EXPECT_LT(c.z, -0.2f);                  // from the viewer's side
}

}  // namespace
}  // namespace kinora
