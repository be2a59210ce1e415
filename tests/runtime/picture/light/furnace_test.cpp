// tests/runtime/picture/light/furnace_test.cpp: closed boxes whose walls shine 1: light between
// them is a geometric series, whichever way it is gathered.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/folders.h"
#include "tests/runtime/expect_colors.h"

namespace kinora {
namespace {

struct Furnace {
    double albedo;
    uint32_t bounces;
};
constexpr Furnace kFurnaces[] = {{0.5, 4}, {0.8, 16}, {1, 64}};

// 1 + a + a^2 + ... of bounces + 1 terms.
double series(const Furnace& furnace) {
    double sum = 0, term = 1;
    for (uint32_t k = 0; k <= furnace.bounces; ++k, term *= furnace.albedo) sum += term;
    return sum;
}

// The wall has its indirect light from `light`, an expression of the normal n.
void expect_series(const char* light, bool of_scene) {
    for (const Furnace& furnace : kFurnaces) {
        SCOPED_TRACE(furnace.albedo);
        SceneText scene;
        scene.cube("box", 20)
            .look("wall", fmt::format("surface wall() {{ normal n = normalize(faceforward(N, I));"
                                      " Oi = 1; Ci = 1 + {} * {}; }}",
                                      furnace.albedo, light))
            .place("box", "wall");
        SceneOptions options;
        options.lights = LightSet::Scene;
        options.quality.ray_depth = options.quality.diffuse_depth = furnace.bounces;
        if (of_scene) options.indirect = furnace.bounces;
        Rendering r(scene.text(), options);
        EXPECT_EQ(r.findings(), "");
        const double want = series(furnace);
        expect_colors(
            r.frame(), [&](dvec2) { return dvec3(want); }, 1e-5 * want);
    }
}

TEST(Furnace, HasItsSeriesByTheSurface) {
    expect_series("indirectdiffuse(P, n, 1)", false);
}

TEST(Furnace, HasItsSeriesByTheScene) {
    expect_series("diffuse(n)", true);
}

double middle_of(const SceneText& scene, uint32_t bounces) {
    SceneOptions options;
    options.lights = LightSet::Scene;
    options.indirect = options.quality.diffuse_depth = bounces;
    Rendering r(scene.text(), options);
    EXPECT_EQ(r.findings(), "");
    r.frame();
    return double(r.color(8, 8).x);
}

SceneText within_box(SceneText scene) {
    scene.cube("box", 20).look("wall", "surface wall() { Oi = 1; Ci = 1; }");
    return scene.place("box", "wall");
}

// They see the box by rays, so its light is not a glow besides.
TEST(Furnace, IsSeenOnceInMirrors) {
    const SceneText mirror = within_box(floor_scene(
        "#include \"broadlights.h\"\n"
        "surface mirror() { normal n = faceforward(normalize(N), I); vector R = reflect(I, n);"
        " Oi = 1; Ci = trace(P, R) + broad_glow(P, n, R); }"));
    for (uint32_t bounces : {0u, 2u}) EXPECT_NEAR(middle_of(mirror, bounces), 1, 1e-5);
}

// A metal of any roughness shows by rays, by the light of other surfaces or by both what it shows
// of ambient light that is as bright.
TEST(Furnace, IsSeenOnceInMetals) {
    for (double rough : {0.0, 0.3, 0.4, 1.0}) {
        const SceneText metal = floor_scene(
            fmt::format("#include \"{}/assets/shaders/gltf_pbr.sl\"\n", project_folder()),
            fmt::format("<shader stage=\"SURFACE\"><bind symbol=\"mirrors\"><float>1</float></bind>"
                        "<bind symbol=\"base_color\"><color>1 1 1</color></bind>"
                        "<bind symbol=\"roughness\"><float>{}</float></bind></shader>",
                        rough));
        SceneText ambient = metal;
        ambient.light("sky", "<ambient><color>1 1 1</color></ambient>");
        EXPECT_NEAR(middle_of(within_box(metal), 2), middle_of(ambient, 0), 1e-4) << rough;
    }
}

}  // namespace
}  // namespace kinora
