// tests/runtime/compiled_layers_test.cpp: shader instances that are compiled together, and those
// that are not.
#include "runtime/scene/build/instances/compiled_layers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_text.h"

namespace kinora {
namespace {

// The shapes among the scene's instances.
size_t shapes(const Rendering& r) {
    KnownLayers known;
    Diagnostics diagnostics;
    for (const auto& look : r.scene->shader_instances) {
        const auto layers = bound_layers(*look, *r.scene->description);
        const CompiledLayers* made = find_or_compile(*look, layers, {}, known, diagnostics);
        EXPECT_NE(made, nullptr);
        EXPECT_EQ(made, find_or_compile(*look, layers, {}, known, diagnostics));
    }
    return known.size();
}

void point_light(SceneText& scene, int k, const char* fade) {
    scene.light(fmt::format("lamp{}", k),
                fmt::format("<point><color>0.{0} 0.{0} 0.{0}</color>{1}</point>", k + 1, fade),
                fmt::format("<translate>{} 0 1</translate>", 0.1 * k));
}

TEST(CompiledLayers, LightsOfOneShapeAreCompiledOnce) {
    SceneText scene = floor_scene(kMatte);
    for (int k = 0; k < 4; ++k) point_light(scene, k, "");
    EXPECT_EQ(shapes(Rendering(scene.text())), 2u);  // and the floor's
    // A number that is exactly 0 or 1 is folded into the code, and any other is not.
    point_light(scene, 4, "<quadratic_attenuation>0.5</quadratic_attenuation>");
    point_light(scene, 5, "<quadratic_attenuation>0.25</quadratic_attenuation>");
    EXPECT_EQ(shapes(Rendering(scene.text())), 3u);
    point_light(scene, 6, "<quadratic_attenuation>1</quadratic_attenuation>");
    EXPECT_EQ(shapes(Rendering(scene.text())), 4u);
}

// Each light has numbers of its own, in kernels that all share: under them the floor has the sum.
TEST(CompiledLayers, SharedKernelsHaveEachTheirNumbers) {
    SceneText all = floor_scene(kMatte);
    dvec3 sum(0);
    for (int k = 0; k < 4; ++k) {
        SceneText one = floor_scene(kMatte);
        for (SceneText* scene : {&all, &one}) point_light(*scene, k, "");
        sum += dvec3(Rendering(one.text()).frame().color(3, 5));
    }
    const dvec3 lit(Rendering(all.text()).frame().color(3, 5));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], sum[c], 1e-5);
    EXPECT_GT(lit[0], 0.1);
}

// A text, too, is folded into the code: two lights of one shader that differ in it alone.
TEST(CompiledLayers, LooksThatDifferInATextAreCompiledApart) {
    SceneText scene;
    scene.square("s");
    const char* code =
        "surface s(string mode = \"\"; float gain = 0.5) "
        "{ Oi = 1; Ci = mode == \"red\" ? color(gain, 0, 0) : color(0, gain, 0); }";
    const char* passes =
        "<shader stage=\"SURFACE\"><bind symbol=\"mode\"><string>{}</string></bind>"
        "<bind symbol=\"gain\"><float>{}</float></bind></shader>";
    scene.look("red", code, fmt::format(fmt::runtime(passes), "red", 0.75))
        .look("green", code, fmt::format(fmt::runtime(passes), "green", 0.25))
        .place("s", "red", "<translate>-1 0 0</translate>")
        .place("s", "green", "<translate>1 0 0</translate>");
    Rendering r(scene.text());
    r.frame();
    EXPECT_EQ(r.color(3, 8), vec3(0.75f, 0, 0));
    EXPECT_EQ(r.color(12, 8), vec3(0, 0.25f, 0));
}

}  // namespace
}  // namespace kinora
