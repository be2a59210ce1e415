// tests/runtime/player/still_test.cpp: what the player comes to is what kinora-render makes.
#include <algorithm>
#include <cstring>

#include "runtime/kinora/open_scene.h"
#include "runtime/picture/frame/frame.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

raytrace::Film rendered(const SceneRequest& request, int64_t frame) {
    OpenedScene opened(request);
    opened.settings.integrator.seed = frame_seed(request, frame);
    raytrace::Film film;
    FrameStats stats;
    EXPECT_TRUE(render_frame(*opened.scene, *opened.pose, opened.rate.time(frame), opened.settings,
                             film, stats, opened.diagnostics));
    return film;
}

void expect_same(const raytrace::Film& a, const raytrace::Film& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    EXPECT_EQ(0, std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(vec4)));
    bool lit = false;
    for (const vec4& pixel : a.rgba) lit |= pixel.x + pixel.y + pixel.z > 0;
    EXPECT_TRUE(lit);
}

class AssetScene : public testing::TestWithParam<const char*> {};

// After playing, orbiting and coming back, with and without a clock.
TEST_P(AssetScene, RefinesToTheBitsOfARender) {
    SceneRequest request = small_request(scene_path(GetParam()), 4);
    bool slow = request.scene.ends_with("rays.dae");  // many rays a pixel
    if (slow) request.width = 16, request.height = 9;
    raytrace::Film wanted = rendered(request, 3);
    for (bool real_time : {false, true}) {
        Played played(request, {real_time, false, nullptr});
        Player& player = played.player;
        ASSERT_EQ(player.load_state(), LoadState::Ready);
        player.wait_picture(kLong);
        EXPECT_TRUE(player.run_line("orbit 20 10").done);
        player.run_line("play on");
        player.advance(0.1);
        player.wait_picture(kLong);
        player.run_line("pause");
        player.run_line("camera");
        player.run_line("seek 3");
        ASSERT_TRUE(player.wait_idle(kLong));
        auto picture = player.picture();
        ASSERT_TRUE(picture && picture->refined) << real_time;
        EXPECT_EQ(picture->samples, 4);
        expect_same(picture->film, wanted);
    }
}

INSTANTIATE_TEST_SUITE_P(All, AssetScene,
                         testing::Values("scenes/walker.dae", "scenes/tintoy.dae",
                                         "scenes/rays.dae", "scenes/matte.dae", "scenes/court.dae",
                                         "scenes/attach.dae", "gltf/bender.glb"));

TEST(Still, ThenNothingIsRenderedAnyMore) {
    Played played(small_request(scene_path("scenes/matte.dae")), {true, false, nullptr});
    ASSERT_TRUE(played.player.wait_idle(kLong));
    uint64_t frames = played.player.frames_rendered();
    EXPECT_GT(frames, 0u);
    uint64_t serial = played.player.picture()->serial;
    clock_t before = clock();  // CPU time of all threads
    for (int k = 0; k < 20; ++k) {
        usleep(5000);
        played.player.advance(0.005);
    }
    EXPECT_LT(double(clock() - before) / CLOCKS_PER_SEC, 0.05);
    EXPECT_TRUE(played.player.idle());
    EXPECT_EQ(played.player.frames_rendered(), frames);
    EXPECT_EQ(played.player.picture()->serial, serial);
}

// The refinement would take minutes; a move ends it, and the picture of the new view comes first. A
// move may fall between two of its frames, where there is nothing to cancel.
TEST(Still, AMoveLetsTheRefinementGo) {
    Played played(small_request(scene_path("scenes/rays.dae"), 1 << 16), {true, false, nullptr});
    Player& player = played.player;
    auto cancelled = [&] {
        std::vector<StageTimes> times = player.stage_times();
        return std::ranges::count_if(times, [](const StageTimes& t) { return t.cancelled; });
    };
    int moves = 0;
    for (; moves < 3 || (cancelled() < 3 && moves < 20); ++moves) {
        ASSERT_TRUE(player.wait_picture(kLong));
        const uint64_t serial = player.picture()->serial;
        ASSERT_TRUE(played.until_busy());  // it refines
        ASSERT_TRUE(player.run_line("orbit 5 0").done);
        ASSERT_TRUE(player.wait_picture(kLong));
        EXPECT_GT(player.picture()->serial, serial);
        EXPECT_FALSE(player.picture()->refined);
    }
    EXPECT_GE(cancelled(), 3) << moves << " moves";
}

// Every frame is late by far, and time goes on while it is made: pictures come all the same.
TEST(Still, APlayerThatIsTooSlowShowsPictures) {
    Played played(small_request(scene_path("scenes/walker.dae")), {true, false, nullptr});
    Player& player = played.player;
    EXPECT_EQ(played.script("hold_rate 240; adapt; size 640 360; play on"), "");
    double after = 1000 * 3600;
    if (player.wait_picture(kLong)) after = player.stage_times().back().at;
    uint64_t first = 0;
    EXPECT_TRUE(played.until(
        [&] {
            if (first == 0 && player.picture()) first = player.picture()->serial;
            return first > 0 && player.picture()->serial >= first + 3;
        },
        0.001));
    for (const StageTimes& times : player.stage_times())
        EXPECT_FALSE(times.cancelled && times.at > after);
}

// Half a second goes by between two pictures: twelve frames are dropped, or none where that is
// chosen.
TEST(Still, EveryFrameIsShownWhereNoneIsToBeDropped) {
    for (bool all : {false, true}) {
        Played played(small_request(scene_path("scenes/walker.dae")), {true, false, nullptr});
        Player& player = played.player;
        EXPECT_EQ(played.script(all ? "first; every_frame; play on" : "first; play on"), "");
        ASSERT_TRUE(player.wait_picture(kLong));
        for (int k = 0; k < 4; ++k) {
            const double before = player.state().time.frame;
            player.advance(0.5);
            ASSERT_TRUE(player.wait_picture(kLong));
            EXPECT_EQ(player.picture()->frame, player.state().time.frame);
            const double moved = player.state().time.frame - before;
            if (all)
                EXPECT_EQ(moved, 1);
            else
                EXPECT_GT(std::abs(moved), 1);
        }
    }
}

TEST(Still, AMissingSceneFailsWithAFinding) {
    Played played(small_request("/nowhere/scene.dae"));
    EXPECT_EQ(played.player.load_state(), LoadState::Failed);
    EXPECT_EQ(played.player.error(), SceneError::Unreadable);
    EXPECT_FALSE(played.player.findings().empty());
    EXPECT_FALSE(played.player.run_line("orbit 1 1").done);
}

TEST(Still, PassesGrowToTheWholeNumberOfSamples) {
    SceneRequest request = small_request(scene_path("scenes/matte.dae"), 32);
    Played played(request, {true, false, nullptr});
    ASSERT_TRUE(played.player.wait_idle(kLong));
    std::vector<int> samples;
    for (const StageTimes& times : played.player.stage_times()) samples.push_back(times.samples);
    ASSERT_GE(samples.size(), 3u);
    EXPECT_EQ(samples.front(), 1);
    EXPECT_EQ(samples[samples.size() - 2], 4);
    EXPECT_EQ(samples.back(), 32);
    expect_same(played.player.picture()->film, rendered(request, 0));
}

}  // namespace
}  // namespace kinora
