// tests/runtime/fewer_rays_test.cpp: shadow rays that are not cast: how many, and what the picture
// loses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "scene_text.h"

namespace kinora {
namespace {

std::string turned(const char* axis, double degrees) {
    return fmt::format("<rotate>{} {}</rotate>", axis, degrees);
}

// A pyramid that covers half of the picture, before a wall.
std::unique_ptr<Rendering> pyramid_under(const std::string& shader,
                                         const std::function<void(SceneText&)>& light_it,
                                         float weak_lights = 0) {
    SceneText scene;
    const dvec3 top(0, 0, 1), right(1, 0, 0), back(0, 1, 0), left(-1, 0, 0), front(0, -1, 0);
    scene.mesh("pyramid", {top, right, back, left, front}, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1});
    scene.look("look", shader).place("pyramid", "look");
    scene.square("wall", 3).place("wall", "look", "<translate>0 0 -2</translate>");
    light_it(scene);
    SceneOptions options;
    options.quality.weak_lights = weak_lights;
    auto r = std::make_unique<Rendering>(scene.text(), options);
    r->frame(64, 64);
    EXPECT_FALSE(r->diagnostics.has_errors()) << r->findings();
    return r;
}

// A loop all around that adds nothing leaves every ray in.
std::string around(const char* sum) {
    return fmt::format(
        "surface s() {{ normal Nf = faceforward(normalize(N), I); Oi = 1; Ci = {};"
        " color none = 0; illuminance(P) none += 0 * Cl; Ci += none; }}",
        sum);
}
std::string about_N(const char* sum) {
    return fmt::format(
        "surface s() {{ normal Nf = faceforward(normalize(N), I); Oi = 1; Ci = {}; }}", sum);
}

// Two of its four faces look away from a sun at the right.
TEST(FewerShadowRays, NoneGoToLightsBehindAllThatTheShaderLooksAbout) {
    auto light_it = [](SceneText& scene) { scene.light("sun", kSun, turned("0 1 0", 80)); };
    const char* sum = "0.8 * diffuse(Nf) + specular(Nf, -normalize(I), 0.2)";
    const auto before = pyramid_under(around(sum), light_it);
    const auto after = pyramid_under(about_N(sum), light_it);
    EXPECT_TRUE(same_bytes(before->film, after->film));
    const uint64_t lit = before->stats.shader_rays.shadow_rays;
    EXPECT_EQ(before->stats.shader_rays.shadow_rays, before->stats.shading_points);
    EXPECT_LT(after->stats.shader_rays.shadow_rays, lit);
    // The two faces are a quarter of the picture.
    EXPECT_NEAR(double(after->stats.shader_rays.shadow_rays) / double(lit), 0.75, 0.02);
}

TEST(FewerShadowRays, NoneGoBeyondASpotsCone) {
    // A cone of 20 degrees from 2 above the floor.
    SceneText scene = floor_scene(kMatte);
    scene.light("spot", "<spot><color>1 1 1</color><falloff_angle>40</falloff_angle></spot>",
                "<translate>0 0 2</translate>");
    Rendering r(scene.text());
    r.frame(64, 64);
    r.frame(64, 64);
    const double radius = 2 * std::tan(radians(20.0));
    EXPECT_NEAR(double(r.stats.shader_rays.shadow_rays), 64 * 64 * kPi * radius * radius / 4, 30);
}

// A bright light and a hundred that are 2^-17 as bright: together less than 2^-9 of the whole.
TEST(FewerShadowRays, NoneGoToLightsThatOthersOutshine) {
    auto light_it = [](SceneText& scene) {
        scene.light("sun", kSun, turned("0 1 0", 10));
        for (int k = 0; k < 100; ++k)
            scene.light(fmt::format("dim{}", k),
                        "<directional><color>7.6e-6 7.6e-6 7.6e-6</color></directional>",
                        turned("1 0 0", 0.2 * k));
    };
    const auto all = pyramid_under(around("diffuse(Nf)"), light_it);
    const auto few = pyramid_under(around("diffuse(Nf)"), light_it, 0x1p-9f);
    EXPECT_EQ(all->stats.shader_rays.shadow_rays, 101 * all->stats.shading_points);
    EXPECT_EQ(few->stats.shader_rays.shadow_rays, few->stats.shading_points);
    EXPECT_LE(difference(all->film, few->film), 0x1p-9f * 1.001f);
    EXPECT_GT(difference(all->film, few->film), 0);
}

// Twenty-five cones side by side: a grid runs the kernels of those that can reach it.
TEST(FewerLightKernels, RunOnlyWhereAConeReaches) {
    auto scene_of = [](double falloff_angle) {
        SceneText scene = floor_scene(kMatte);
        for (int k = 0; k < 16; ++k)  // of more, each point would choose some
            scene.light(fmt::format("spot{}", k),
                        fmt::format("<spot><color>1 1 1</color><falloff_angle>{}</falloff_angle>"
                                    "</spot>",
                                    falloff_angle),
                        fmt::format("<translate>{} {} 0.5</translate>", 0.5 * (k % 4) - 0.75,
                                    0.5 * (k / 4) - 0.75));
        Rendering r(scene.text());
        return r.frame(256, 256).stats.light_points;
    };
    // Circles of radius 0.14 on a floor of 4: each tile of 64 pixels is a quarter of the width.
    const uint64_t narrow = scene_of(31), wide = scene_of(179);
    EXPECT_EQ(wide, 16u * 256 * 256);
    EXPECT_LT(narrow, wide / 3);
    // The same circles by a shader of the same arithmetic whose reach is not known.
    SceneText free = floor_scene(kMatte);
    SceneText bounded = floor_scene(kMatte);
    const char* spot =
        "light spot() { illuminate(P, vector \"shader\" (0, 0, 1), radians(15.5)) { Cl = 1; } }";
    for (int k = 0; k < 4; ++k) {
        const std::string place = fmt::format("<translate>{} 0.1 0.5</translate>", 0.4 * k - 0.6);
        free.rsl_light(fmt::format("spot{}", k), spot, place);
        bounded.light(fmt::format("spot{}", k),
                      "<spot><color>1 1 1</color><falloff_angle>31</falloff_angle></spot>", place);
    }
    Rendering a(free.text()), b(bounded.text());
    EXPECT_TRUE(same_bytes(a.frame(256, 256).film, b.frame(256, 256).film));
    EXPECT_LT(b.stats.light_points, a.stats.light_points / 2);
}

// Nine hundred circles that touch none of their neighbours: a point is lit by one light at most.
// Where there are many lights, few points are lit at once, and only lights that reach them run.
TEST(FewerLightKernels, OfNineHundredConesRunForFew) {
    SceneText scene = floor_scene(kMatte);
    constexpr int kSide = 30;
    constexpr int kPixels = 251;  // no multiple: a light's square is no whole number of them
    for (int k = 0; k < kSide * kSide; ++k)
        scene.light(
            fmt::format("spot{}", k),
            "<spot><color>1 1 1</color><falloff_angle>31</falloff_angle></spot>",
            fmt::format("<translate>{} {} 0.1</translate>", 2.0 / kSide * (k % kSide + 0.5) - 1,
                        2.0 / kSide * (double(k / kSide) + 0.5) - 1));
    Rendering r(scene.text());
    r.frame(kPixels, kPixels);
    EXPECT_LT(r.stats.light_points, uint64_t(kPixels) * kPixels * kSide * kSide / 50);
    // tan 15.5 degrees at a height of 0.1 is the radius of a circle, in squares of 2 / 30.
    const double radius = 0.1 * std::tan(radians(15.5));
    const double share = kPi * radius * radius / (2.0 / kSide) / (2.0 / kSide);
    int lit = 0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) lit += r.color(x, y)[0] > 0.5f;
    EXPECT_NEAR(lit / (double(kPixels) * kPixels), share, 0.02);
}

}  // namespace
}  // namespace kinora
