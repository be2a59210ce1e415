// tests/runtime/picture/light/furnace_test.cpp: closed boxes whose walls shine 1: light between
// them is a geometric series, whichever way it is gathered.
#include <gtest/gtest.h>

#include <fmt/format.h>

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

}  // namespace
}  // namespace kinora
