// tests/runtime/play/edits_test.cpp: what an edit costs: kernels in a scene that stands, no memory
// that stays, and a player that shows pictures whatever is typed.
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "jit/compiler.h"
#include "runtime/play/scene_maker.h"
#include "tests/rsl/random_shader.h"
#include "tests/runtime/play/played.h"

#include <dlfcn.h>
namespace kinora {
namespace {

std::vector<uint8_t> refined(Player& player) {
    EXPECT_TRUE(player.wait_idle(kLong));
    return player.picture()->rgba;
}

// The walker as a command line gives that parameter.
std::vector<uint8_t> walker_with(const std::string& value) {
    SceneRequest request = small_request(scene_path("scenes/walker.dae"));
    request.params.emplace_back("wall-material.Kd", value);
    Played played(request);
    return refined(played.player);
}

// The walls and the trim wear the shader: a kernel each.
TEST(Swap, AnEditCompilesItsKernelsAndBuildsNoScene) {
    Played played("scenes/walker.dae");
    Player& player = played.player;
    std::vector<uint8_t> before = refined(player);
    EXPECT_EQ(player.made().scenes, 1u);
    EXPECT_EQ(player.made().kernels, 0u);
    EXPECT_EQ(played.script("select_material wall-material; edit; find \"value * (Ka\"; type 0*"),
              "");
    EXPECT_NE(refined(player), before);
    EXPECT_EQ(player.made().scenes, 1u);
    EXPECT_EQ(player.made().kernels, 2u);
    EXPECT_EQ(played.script("type \"x(\""), "");  // cannot be compiled
    refined(player);
    EXPECT_EQ(player.made().kernels, 2u);
    EXPECT_EQ(played.script("undo"), "");
    EXPECT_EQ(refined(player), before);
    EXPECT_EQ(player.made().scenes, 1u);
    EXPECT_EQ(player.made().kernels, 4u);
}

// The number that `param` gives has a place in the frame block; 1 is another shape of the kernel.
TEST(Swap, AParameterCompilesOnlyWhereItsShapeChanges) {
    Played played("scenes/walker.dae");
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material wall-material; param Kd 0.25"), "");
    refined(player);
    EXPECT_EQ(player.made().kernels, 1u);  // it was the shader's own constant
    EXPECT_EQ(played.script("param Kd 0.5; wait refined; param Kd 0.75"), "");
    EXPECT_EQ(refined(player), walker_with("0.75"));
    EXPECT_EQ(player.made().kernels, 1u);
    EXPECT_EQ(played.script("param Kd 1"), "");
    EXPECT_EQ(refined(player), walker_with("1"));
    EXPECT_EQ(player.made().kernels, 2u);
    EXPECT_EQ(played.script("param surface_color 0.2"), "");
    refined(player);
    EXPECT_EQ(played.script("undo; undo"), "");
    EXPECT_EQ(refined(player), walker_with("0.75"));
    EXPECT_EQ(player.made().scenes, 1u);
}

// What takes more than a kernel is built, and shows the same as a scene read that way.
TEST(Swap, WhatChangesMoreThanAKernelIsBuilt) {
    Played played("scenes/matte.dae");
    Player& player = played.player;
    EXPECT_EQ(played.script("hide right"), "");
    refined(player);
    EXPECT_EQ(player.made().scenes, 2u);
    EXPECT_EQ(played.script("select_material bright; edit; "
                            "set_text \"surface a(float other = 1) { Ci = other / 2, Oi = 0.5 }\""),
              "");
    refined(player);
    EXPECT_EQ(player.made().scenes, 2u);  // a slip
    ASSERT_TRUE(
        player.run("set_text", {"surface a(float other = 1) { Ci = other / 2; Oi = 0.5; }"}).done);
    refined(player);
    EXPECT_EQ(player.made().scenes, 3u);  // its parameters are others, and it is seen through
    EXPECT_EQ(player.shader().shown, player.shader().version);
}

// Bytes that the allocator has given out, and of them what is mapped by itself.
size_t used_memory() {
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

// Texts by a fixed generator: whole shaders, small changes, broken ones.
class Typist {
  public:
    explicit Typist(std::string text) : text_(std::move(text)) {}

    std::string next() {
        if (draw(2) == 0) return rsl::random_shader(draw(64), false);
        static constexpr const char* kPieces[] = {
            "(", ";", "}", "Ci", "= 3", "\"", "while (1)", "#", "normal", "/* ok */", " ", "\n"};
        std::string edited = text_;
        edited.insert(draw(uint32_t(text_.size())), kPieces[draw(std::size(kPieces))]);
        return edited;
    }

  private:
    uint32_t draw(size_t below) {
        state_ = state_ * 1664525u + 1013904223u;
        return (state_ >> 8) % uint32_t(below);
    }
    std::string text_;
    uint32_t state_ = 7;
};

void edit(Player& player, Typist& typist, int count) {
    for (int k = 0; k < count; ++k) {
        ASSERT_TRUE(player.run("set_text", {typist.next()}).done);
        player.advance(0.01);
        if (k % 8 == 0) {
            ASSERT_TRUE(player.wait_picture(kLong)) << k;
        }
    }
}

size_t memory_with(Player& player, const std::string& text) {
    EXPECT_TRUE(player.run_line("play off").done);
    // What undo would find is let go for these, which are the same kernels.
    for (size_t k = 40; k-- > 0;) {
        EXPECT_TRUE(player.run("set_text", {text + std::string(k, ' ')}).done);
        EXPECT_TRUE(player.wait_picture(kLong));
    }
    EXPECT_TRUE(player.run_line("seek 1").done);
    EXPECT_TRUE(player.wait_idle(kLong));
    EXPECT_EQ(player.shader().shown, player.shader().version);
    EXPECT_TRUE(player.picture()->refined);
    jit::clear_cache();  // the player does so after every so many edits; what is held stays
    size_t used = used_memory();
    EXPECT_TRUE(player.run_line("play on").done);
    return used;
}

// Disabled: memory grows by some 0.3 % a hundred edits, and why is not known. In a folder of its
// own: some of the shaders write files beside the scene.
TEST(Edits, DISABLED_AThousandAtRandomLeaveNothingBehind) {
    const std::string file = testing::TempDir() + "kinora_play_edits.dae";
    write(file, text_of(scene_path("scenes/walker.dae")));
    Played played(small_request(file), {true, false, nullptr});
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material wall-material; edit; play on"), "");
    const std::string text = player.shader().text;
    Typist typist(text);
    double longest = 0;
    std::array<size_t, 4> used{};
    std::vector<size_t> kernels;  // that the cache holds
    auto heap_mark = (void (*)(int))dlsym(RTLD_DEFAULT, "heap_mark");
    int round = 0;
    for (size_t& bytes : used) {
        if (heap_mark && round == 2) heap_mark(1);
        if (heap_mark && round == 3) heap_mark(2);
        ++round;
        for (int k = 0; k < 4; ++k) {
            edit(player, typist, 70);
            for (const StageTimes& times : player.stage_times())
                longest = std::max(longest, times.total);
        }
        bytes = memory_with(player, text);
        kernels.push_back(jit::cache_stats().kernels);
    }
    if (heap_mark) heap_mark(3);
    const MakerCounts made = player.made();
    std::printf("memory %.1f %.1f %.1f %.1f MB; longest frame %.0f ms; %d kernels, %d scenes\n",
                double(used[0]) / 1e6, double(used[1]) / 1e6, double(used[2]) / 1e6,
                double(used[3]) / 1e6, longest, int(made.kernels), int(made.scenes));
    for (size_t count : kernels) EXPECT_EQ(count, kernels.front());
    // The first parts size buffers for the hardest texts; what leaks grows in the last one too.
    EXPECT_LE(double(used[3]), 1.01 * double(used[2]));
}

}  // namespace
}  // namespace kinora
