// tests/runtime/player/stop_test.cpp: shaders that loop for ever hold up nothing but their picture.
#include "runtime/base/stats.h"
#include "runtime/player/picture/picture.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

// Each would take hours: a million turns for each of its 230 400 pixels, or a thousand million.
constexpr const char* kEndless[] = {
    "surface s(float Ka = 1; float Kd = 1) { float k = 0; while (1) k += u; Ci = k; Oi = 1; }",
    "surface s(float Ka = 1; float Kd = 1) { float k = 0; uniform float i; uniform float j;"
    " uniform float h; for (i = 0; i < 1000; i += 1) for (j = 0; j < 1000; j += 1)"
    " for (h = 0; h < 1000; h += 1) k += u; Ci = k; Oi = 1; }",
    "surface s(float Ka = 1; float Kd = 1) { color c = 0; while (u < 2)"
    " c += trace(P, normalize(N + vector(noise(P * 100)))); Ci = c; Oi = 1; }",
    "surface s(float Ka = 1; float Kd = 1) { uniform float k = 0; while (k >= 0) k += 1; Ci = k; }",
};
constexpr const char* kGood =
    "surface s(float Ka = 1; float Kd = 1) { Ci = color(0, 1, 0); Oi = 1; }";
// Far less than these, far more than the milliseconds that a stop takes: other work may hold both
// processors.
constexpr double kSoon = 20;

SceneRequest large_request() {
    SceneRequest request = small_request(scene_path("scenes/matte.dae"), 16);
    request.width = 640;
    request.height = 360;
    return request;
}

// Until a frame is in work, and its threads are in the loops of the shader.
void let_run(Played& played, uint64_t begun) {
    ASSERT_TRUE(played.until([&] { return played.player.frames_rendered() > begun; }, 0.01));
    ASSERT_TRUE(played.until_busy());
}

std::vector<uint8_t> picture_with(Played& played, const char* text) {
    EXPECT_TRUE(played.player.run("set_text", {text}).done);
    EXPECT_TRUE(played.player.wait_idle(kLong));
    return played.player.picture()->rgba;
}

TEST(Stop, AnEndlessShaderGivesWayToTheNextOne) {
    for (bool real_time : {true, false}) {
        Played played(large_request(), {real_time, false, nullptr});
        ASSERT_EQ(played.script("select_material bright; edit"), "");
        const std::vector<uint8_t> green = picture_with(played, kGood);
        for (const char* endless : kEndless) {
            const uint64_t begun = played.player.frames_rendered();
            ASSERT_TRUE(played.player.run("set_text", {endless}).done);
            let_run(played, begun);
            Stopwatch watch;
            EXPECT_EQ(picture_with(played, kGood), green) << endless;
            EXPECT_LT(watch.ms(), 1000 * kSoon) << endless;
        }
    }
}

TEST(Stop, ACameraMoveEndsAnEndlessFrame) {
    Played played(large_request(), {true, false, nullptr});
    Player& player = played.player;
    // With all pixels: a few of them are done in time even with a million turns each.
    ASSERT_EQ(played.script("adapt; select_material bright; edit"), "");
    picture_with(played, kGood);
    uint64_t begun = player.frames_rendered();
    ASSERT_TRUE(player.run("set_text", {kEndless[1]}).done);
    let_run(played, begun);
    for (int k = 0; k < 3; ++k) {
        begun = player.frames_rendered();
        ASSERT_EQ(played.script("orbit 10 0"), "");
        let_run(played, begun);  // another one is in work
    }
    EXPECT_TRUE(player.stage_times().back().cancelled);
    // Closing ends it, too.
}

}  // namespace
}  // namespace kinora
