// tests/runtime/defaults_test.cpp: the camera and lights of scenes that bring none.
#include "runtime/build/defaults.h"

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

TEST(DefaultCamera, LooksAlongTheDiagonalOfTheUpAxisFrameAtTheBounds) {
    struct {
        const char* up;
        dvec3 direction;  // right + 0.6 up + towards the viewer, of COLLADA's up_axis table
    } rows[] = {{"X_UP", {0.6, -1, 1}}, {"Y_UP", {1, 0.6, 1}}, {"Z_UP", {1, -1, 0.6}}};
    for (const auto& row : rows) {
        Rendering r(bare_scene(row.up, "<translate>5 6 7</translate>").text());
        ASSERT_TRUE(r.scene) << r.findings();
        EXPECT_TRUE(added(r, "default camera"));
        r.frame();
        dvec3 from_centre = glm::normalize(r.scene->view.eye + r.scene->origin - dvec3(5, 6, 7));
        dvec3 want = glm::normalize(row.direction);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(from_centre[k], want[k], 1e-9) << row.up;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.scene->view.forward[k], -want[k], 1e-9);
        EXPECT_NEAR(r.scene->view.half_height, std::tan(radians(18.5)), 1e-12);
    }
}

TEST(DefaultCamera, HasTheWholeObjectInThePicture) {
    for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
        Rendering r(bare_scene(up, "<scale>100 300 200</scale>").text());
        r.frame(64, 64);
        int inside = 0, border = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                bool covered = r.film.at(x, y).w > 0;
                inside += covered;
                border += covered && (x == 0 || y == 0 || x == 63 || y == 63);
            }
        EXPECT_EQ(border, 0) << up;
        EXPECT_GT(inside, 300) << up;
    }
}

TEST(DefaultCamera, FramesTheWholeRangePlayed) {
    SceneText scene = bare_scene("Y_UP", "<translate sid=\"t\">0 0 0</translate>");
    scene.nodes.replace(scene.nodes.find("<node>"), 6, "<node id=\"ball-node\">");
    scene.animate("ball-node/t.X", {0, 1}, {0, 20});
    SceneOptions options;
    options.end_time = 1;
    Rendering r(scene.text(), options);
    for (double time : {0.0, 0.5, 1.0}) {
        r.frame(48, 48, time);
        int inside = 0, border = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                bool covered = r.film.at(x, y).w > 0;
                inside += covered;
                border += covered && (x == 0 || y == 0 || x == 47 || y == 47);
            }
        EXPECT_GT(inside, 0) << time;
        EXPECT_EQ(border, 0) << time;
    }
}

TEST(DefaultLights, ComeWhereThereIsNoneOrAmbientAlone) {
    Rendering none(bare_scene("Y_UP").text());
    EXPECT_TRUE(added(none, "default light") && added(none, "default ambient light"));
    SceneText scene = bare_scene("Y_UP");
    scene.light("sky", "<ambient><color>1 1 1</color></ambient>");
    Rendering ambient(scene.text());
    EXPECT_TRUE(added(ambient, "default light"));
    EXPECT_FALSE(added(ambient, "default ambient light"));
    scene.light("sun", "<directional><color>1 1 1</color></directional>");
    Rendering lit(scene.text());
    EXPECT_FALSE(added(lit, "default light"));
}

TEST(DefaultLights, AmbientLightIsThreeTwentieths) {
    SceneText scene = bare_scene("Y_UP");
    scene.effects.clear();
    scene.materials.clear();
    scene.look("l", "surface s() { Oi = 1; Ci = ambient(); }");
    Rendering r(scene.text());
    r.frame();
    vec3 seen = r.color(8, 8);
    for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(seen[k], 0.15f);
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

TEST(DefaultLights, ShineFromOverTheCamerasLeftShoulder) {
    SceneText scene = bare_scene("Y_UP");
    scene.effects = scene.materials = "";
    // Shows the light's direction from the surface in camera space.
    scene.look("l",
               "surface s() { Oi = 1; Ci = 0; illuminance(P, -I, PI) {"
               " vector d = normalize(L); Ci = color(xcomp(d), ycomp(d), zcomp(d)); } }");
    Rendering r(scene.text());
    vec3 c = r.frame(15, 15).color(7, 7);
    EXPECT_LT(c.x, -0.2f) << r.findings();  // left
    EXPECT_GT(c.y, 0.2f);                   // up
    EXPECT_LT(c.z, -0.2f);                  // from the viewer's side
}

}  // namespace
}  // namespace kinora
