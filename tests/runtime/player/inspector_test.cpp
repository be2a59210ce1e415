// tests/runtime/player/inspector_test.cpp: what is looked up in a scene while its pictures are made
// and its shaders are edited.
#include "runtime/player/inspector.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "runtime/player/pixel/pixel_story.h"
#include "runtime/player/render_loop.h"
#include "runtime/player/scene_maker.h"
#include "runtime/scene/camera.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

constexpr const char* kWall = "wall-material";
constexpr int kX = 3, kY = 3;
constexpr int kFrames = 20;

// The number of the text is its color.
std::string wall_text(int number) {
    return "surface a() { Ci = " + std::to_string(number) + "; Oi = 1; }";
}

std::unique_ptr<MadeScene> taken(SceneMaker& maker) {
    std::unique_ptr<MadeScene> made;
    while (!(made = maker.take())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return made;
}

SceneEdits edits_of(int number) {
    SceneEdits edits;
    edits.texts.push_back(
        {kWall, scene_path("scenes/walker.dae"), wall_text(number), uint64_t(number)});
    return edits;
}

ViewOrder order_at(double frame) {
    ViewOrder order;
    order.frame = frame;
    order.width = 64;
    order.height = 36;
    return order;
}

// A scene as it was shown, and the number of its wall's text.
struct Edition {
    std::shared_ptr<const ShownScene> shown;
    int number = 0;
};

struct Found {
    PickedPixel picked;
    std::shared_ptr<const PixelStory> story;
};

Found find(const Inspected& inspected) {
    return {pick_pixel(inspected, kX, kY), story_of(inspected, kX, kY)};
}

// `there`: the material that the pixel shows at the order's frame.
void expect_found(const Found& found, const std::string& there, int number) {
    EXPECT_EQ(found.picked.material, there);
    const bool edited = found.picked.shader == "a";  // by the trim, too
    EXPECT_TRUE(edited || there != kWall);
    ASSERT_TRUE(found.story);
    ASSERT_FALSE(found.story->points.empty());
    EXPECT_EQ(found.story->points.front().agreement, Agreement::Agrees);
    if (edited) {
        EXPECT_EQ(found.story->points.front().Ci[0], float(number));
    }
    ASSERT_FALSE(found.story->rays.empty());
    EXPECT_EQ(found.story->rays.front().kind, StoryRay::Kind::Eye);
}

// In a pose of the calling thread.
Found find_here(const ShownScene& shown, const ViewOrder& order) {
    Pose pose(*shown.scene);
    PlacedCamera placed;
    const FrameSettings settings = refined_settings(shown, *shown.scene, pose, order, placed);
    FrameStats stats;
    Diagnostics ignored;
    const bool stands =
        pose_frame(*shown.scene, pose, time_of(shown, order), settings, stats, ignored);
    return find({shown, *shown.scene, pose, order, settings, stands});
}

TEST(Inspector, FindsWhatASceneShowsWhileItIsRenderedAndSwapped) {
    SceneMaker maker([] {}, true, false);
    maker.open(small_request(scene_path("scenes/walker.dae"), 4), edits_of(1), true);
    auto first = taken(maker);
    ASSERT_TRUE(first->shown);
    std::mutex mutex;
    Edition newest{first->shown, 1};
    const std::shared_ptr<const Scene> built = first->shown->scene;
    std::vector<std::string> there;
    for (int frame = 0; frame < kFrames; ++frame)
        there.push_back(find_here(*newest.shown, order_at(frame)).picked.material);
    ASSERT_GT(std::ranges::count(there, kWall), 0);
    ASSERT_LT(std::ranges::count(there, kWall), kFrames);
    RenderLoop loop(true, [] {});
    Inspector inspector([] {});
    loop.show(std::move(first), order_at(1), {});

    std::atomic<bool> ends = false;
    std::atomic<int> answered = 0, asked = 0, found_here = 0;
    const auto edition = [&] {
        std::lock_guard lock(mutex);
        return newest;
    };
    const auto ask = [&](int thread) {
        for (int k = 0; !ends; ++k) {
            const Edition now = edition();
            const int frame = (7 * thread + k) % kFrames;
            const ViewOrder order = order_at(frame);
            if (k % 2) {
                expect_found(find_here(*now.shown, order), there[size_t(frame)], now.number);
                ++found_here;
                continue;
            }
            ++asked;
            inspector.add(
                {now.shown, now.shown->scene, order, true, [&, now, frame](Inspected& inspected) {
                     const Found found = find(inspected);
                     return [&, found, now, frame] {
                         expect_found(found, there[size_t(frame)], now.number);
                         ++answered;
                     };
                 }});
        }
    };
    std::thread threads[] = {std::thread(ask, 0), std::thread(ask, 1), std::thread(ask, 2)};
    for (int number = 2; number <= 12; ++number) {
        maker.edit(edits_of(number));
        auto made = taken(maker);
        ASSERT_TRUE(made->swapped);
        EXPECT_EQ(made->shown->scene->meshes.data(), built->meshes.data());
        EXPECT_EQ(made->shown->scene->textures, built->textures);
        {
            std::lock_guard lock(mutex);
            newest = {made->shown, number};
        }
        loop.swap(made->shown);
        loop.order(order_at(number), {});
        for (int k = 0; k < 10 && !loop.caught_up(); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        for (const Answer& answer : inspector.take()) answer();
    }
    ends = true;
    for (std::thread& thread : threads) thread.join();
    while (!inspector.idle()) {
        for (const Answer& answer : inspector.take()) answer();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(answered, asked);
    EXPECT_GT(asked, 0);
    EXPECT_GT(found_here, 0);
    while (!loop.idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const PictureSource source = loop.source();
    EXPECT_EQ(source.shown, newest.shown);
    EXPECT_EQ(source.picture->frame, 12);
}

// A frame that would take hours is in work, and none is ended for the answer.
TEST(Inspector, AClickWaitsForNoFrame) {
    SceneRequest request = small_request(scene_path("scenes/walker.dae"));
    request.width = 640;
    request.height = 360;
    Played played(request, {true, false, nullptr});
    Player& player = played.player;
    ASSERT_TRUE(player.wait_idle(kLong));
    const auto pixel_at = [&](int x) {
        EXPECT_TRUE(player.run("click", {std::to_string(x), "180"}).done);
        EXPECT_TRUE(player.wait_picture(kLong));
        return player.state().selection.pixel.value_or(PickedPixel{});
    };
    int there = 0;  // another shader than the wall's
    for (int x = 0; x < 640 && !there; x += 10) {
        const PickedPixel pixel = pixel_at(x);
        if (pixel.shader == "statue") there = x;
    }
    ASSERT_GT(there, 0);
    ASSERT_EQ(played.script("adapt; select_material wall-material; edit"), "");
    ASSERT_TRUE(player.wait_idle(kLong));
    const uint64_t before = player.frames_rendered();
    ASSERT_TRUE(player
                    .run("set_text", {"surface s(float Ka = 1; float Kd = 1) { float k = 0;"
                                      " uniform float i, j, h; for (i = 0; i < 1000; i += 1)"
                                      " for (j = 0; j < 1000; j += 1)"
                                      " for (h = 0; h < 1000; h += 1) k += u; Ci = k; Oi = 1; }"})
                    .done);
    while (player.frames_rendered() == before) {
        player.advance(0.01);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    player.run("select", {player.scene()->nodes.front().path});
    ASSERT_FALSE(player.state().selection.pixel);
    ASSERT_TRUE(player.run("click", {std::to_string(there), "180"}).done);
    const uint64_t begun = player.frames_rendered();
    for (int k = 0; k < 100'000 && !player.state().selection.pixel; ++k) {
        player.advance(0);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(player.state().selection.pixel);
    EXPECT_TRUE(player.state().selection.pixel->hit);
    EXPECT_TRUE(player.state().selection.story);
    EXPECT_EQ(player.frames_rendered(), begun);
}

}  // namespace
}  // namespace kinora
