// tests/runtime/player/rays_test.cpp: the rays of a clicked pixel, and where pictures show them;
// the machine code of its shader.
#include <cmath>
#include <glm/geometric.hpp>

#include "jit/target.h"
#include "runtime/player/pixel/draw_rays.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

using Kind = StoryRay::Kind;

// The wall's pixel (3, 3) with that shader on it.
struct Clicked : Played {
    explicit Clicked(const std::string& shader) : Played("scenes/walker.dae") {
        EXPECT_EQ(script("select_material stone-material; edit"), "");
        EXPECT_TRUE(player.run("set_text", {shader}).done);
        EXPECT_TRUE(player.wait_idle(kLong));
        EXPECT_EQ(script("click 3 3"), "");
        const auto& selection = player.state().selection;
        EXPECT_TRUE(selection.story && selection.pixel && selection.pixel->hit);
        if (!selection.story || !selection.pixel) return;
        story = *selection.story;
        P = selection.pixel->P;
        picture = player.picture();
    }
    std::vector<StoryRay> of(Kind kind) const {
        std::vector<StoryRay> found;
        for (const StoryRay& ray : story.rays)
            if (ray.kind == kind) found.push_back(ray);
        return found;
    }
    dvec3 eye() const { return picture->origin + picture->view.eye; }

    PixelStory story;
    dvec3 P{0.0};
    std::shared_ptr<const Picture> picture;
};

TEST(Rays, AreThoseThatTheShaderShoots) {
    Clicked plain("surface a() { Ci = 1; Oi = 1; }");
    ASSERT_EQ(plain.story.rays.size(), 1u);
    const StoryRay eye = plain.story.rays[0];
    EXPECT_EQ(eye.kind, Kind::Eye);
    EXPECT_TRUE(eye.hit);
    EXPECT_LT(glm::distance(eye.from, plain.eye()), 1e-4);
    const double away = glm::distance(eye.from, eye.to);
    const double pixel = away * plain.picture->view.half_height / 18;  // at that distance
    EXPECT_LT(glm::distance(eye.to, plain.P), 4 * pixel);  // the sample is not the pixel's center

    Clicked lit("surface a() { Ci = diffuse(faceforward(normalize(N), I)); Oi = 1; }");
    EXPECT_TRUE(lit.of(Kind::Traced).empty());
    ASSERT_FALSE(lit.of(Kind::Shadow).empty());
    for (const StoryRay& ray : lit.of(Kind::Shadow))
        EXPECT_LT(std::min(glm::distance(ray.from, eye.to), glm::distance(ray.to, eye.to)),
                  1e-3 * away);

    Clicked mirror(
        "surface a() { vector R = reflect(normalize(I), faceforward(normalize(N), I));\n"
        "    Ci = trace(P, R); Oi = 1; }");
    ASSERT_FALSE(mirror.of(Kind::Traced).empty());
    const StoryRay first = mirror.of(Kind::Traced)[0];
    EXPECT_LT(glm::distance(first.from, eye.to), 1e-3 * away);
    // As far in front of the wall as it goes: the angles to its normal are the same.
    const dvec3 N = mirror.player.state().selection.pixel->N;
    EXPECT_NEAR(glm::dot(glm::normalize(first.to - first.from), N),
                glm::dot(glm::normalize(eye.from - eye.to), N), 1e-3);
}

// The inverse of camera_ray(), which makes the picture.
TEST(Rays, AreSeenWhereTheCameraSeesThem) {
    for (const char* line : {"orbit 30 20", "orbit -70 10; parallel"}) {
        Played played("scenes/walker.dae");
        ASSERT_EQ(played.script(line), "");
        ASSERT_TRUE(played.player.wait_idle(kLong));
        const auto picture = played.player.picture();
        for (double x : {0.5, 17.25, 40.0, 63.5})
            for (double y : {0.5, 20.75, 35.5})
                for (double t : {0.5, 3.0, 50.0}) {
                    const raytrace::CameraRay ray = raytrace::camera_ray(picture->view, x, y);
                    const dvec3 at = picture->origin + dvec3(ray.org) + t * dvec3(ray.dir);
                    const dvec3 forward = picture->view.forward;
                    const auto seen =
                        seen_segment(picture->view, picture->origin, at, at + forward);
                    ASSERT_TRUE(seen);
                    EXPECT_NEAR(seen->first.x, x, 1e-3) << line;
                    EXPECT_NEAR(seen->first.y, y, 1e-3) << line;
                }
    }
}

TEST(Rays, BehindTheCameraAreNotSeen) {
    raytrace::Camera camera;
    camera.width = 64, camera.height = 36;
    camera.axis = {32, 18};
    camera.raster_dx = {0.05, 0, 0};
    camera.raster_dy = {0, -0.05, 0};
    EXPECT_FALSE(seen_segment(camera, dvec3(0.0), {0, 0, -1}, {3, 1, -2}));
    const auto seen = seen_segment(camera, dvec3(0.0), {0, 0, -1}, {0.5, 0, 1});
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->second.x, 32 + 0.5 / 0.05, 1e-9);
    EXPECT_GT(seen->first.x, 64);  // it comes from far outside
    const auto back = seen_segment(camera, dvec3(0.0), {0.5, 0, 1}, {0, 0, -1});
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->first.x, seen->second.x, 1e-9);
    EXPECT_NEAR(back->second.x / seen->first.x, 1, 1e-9);
}

TEST(Rays, AreDrawnAlongTheirLine) {
    raytrace::Camera camera;
    camera.orthographic = true;
    camera.width = 64, camera.height = 36;
    camera.axis = {32, 18};
    camera.raster_dx = {1, 0, 0};
    camera.raster_dy = {0, -1, 0};
    std::vector<uint8_t> rgba(4 * 64 * 36, 0);
    // From beyond the left border to the middle, in row 9.
    const StoryRay ray{Kind::Shadow, {-100, 8.5, 5}, {0, 8.5, 5}, true};
    draw_rays({&ray, 1}, camera, dvec3(0.0), 64, 36, rgba);
    auto at = [&](int x, int y) { return &rgba[4 * size_t(y * 64 + x)]; };
    for (int x = 0; x < 32; ++x) {
        EXPECT_GT(at(x, 9)[0], 180) << x;
        EXPECT_LT(at(x, 9)[2], 90) << x;
        EXPECT_EQ(at(x, 9)[3] > 180, true) << x;
        EXPECT_EQ(at(x, 4)[0], 0) << x;
    }
    for (int x = 36; x < 64; ++x) EXPECT_EQ(at(x, 9)[0], 0) << x;
    // Twice the pixels: the same place.
    std::vector<uint8_t> large(4 * 128 * 72, 0);
    draw_rays({&ray, 1}, camera, dvec3(0.0), 128, 72, large);
    EXPECT_GT(large[4 * (18 * 128 + 20)], 150);  // between two rows: three quarters of each
    EXPECT_GT(large[4 * (19 * 128 + 20)], 150);
    EXPECT_EQ(large[4 * (25 * 128 + 20)], 0);
}

TEST(Rays, StandInThePictureUntilTheyAreTakenAway) {
    Clicked lit("surface a() { Ci = diffuse(faceforward(normalize(N), I)); Oi = 1; }");
    Player& player = lit.player;
    auto shown = [&] {
        EXPECT_TRUE(player.wait_idle(kLong));
        return player.picture()->rgba;
    };
    EXPECT_EQ(lit.script("orbit 40 20"), "");
    const auto without = shown();
    EXPECT_EQ(lit.script("rays"), "");
    const auto with = shown();
    size_t changed = 0;
    for (size_t k = 0; k < with.size(); k += 4)
        changed += !std::equal(&with[k], &with[k] + 4, &without[k]);
    EXPECT_GT(changed, 10u);
    EXPECT_LT(changed, with.size() / 4 / 2);
    EXPECT_EQ(lit.script("rays"), "");
    EXPECT_EQ(shown(), without);
}

// Arithmetic of points has code at its line; what is the same for all points has none there.
TEST(Rays, MachineCodeStandsWithItsLine) {
    Clicked shaded(
        "surface a(float k = 0.25) {\n"
        "    float wave = sin(u * 20);\n"
        "    Ci = wave * wave;\n"
        "    Oi = 1;\n"
        "}\n");
    const PointStory& point = shaded.story.points.at(0);
    EXPECT_EQ(point.target, jit::best_target().name);
    if (point.target == std::string("interp")) return;
    ASSERT_EQ(point.no_code, "");
    size_t of_line[6] = {};
    for (const MachineRun& run : point.code) {
        if (run.line < 1 || run.line > 5) continue;
        of_line[run.line] += run.instructions.size();
        if (run.line == 2) {
            EXPECT_EQ(run.source, "float wave = sin(u * 20);");
        }
    }
    EXPECT_GT(of_line[2], 10u) << to_json(shaded.story);
    EXPECT_GT(of_line[3], 0u);
    // The same instructions, from other lines.
    EXPECT_EQ(shaded.script("caret 1 1; type \"/* two\\nlines */\\n\"; wait refined; click 3 3"),
              "");
    const PointStory moved = shaded.player.state().selection.story->points.at(0);
    size_t below = 0;
    for (const MachineRun& run : moved.code) {
        EXPECT_NE(run.line, 2);
        if (run.source == "float wave = sin(u * 20);" && run.line == 4)
            below += run.instructions.size();
    }
    EXPECT_EQ(below, of_line[2]);
}

}  // namespace
}  // namespace kinora
