// tests/runtime/defaults_test.cpp: the lights of scenes that bring none (cameras:
// cameras_test.cpp).
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
