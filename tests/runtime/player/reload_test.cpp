// tests/runtime/player/reload_test.cpp: files that change while they are shown.
#include <filesystem>
#include <fstream>

#include "runtime/scene/images/image_io.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

// Until the scene shown or the findings are other ones.
bool wait_for_news(Played& played, const std::string& scene, size_t findings) {
    const Player& player = played.player;
    return played.until([&] {
        return player.observe(Observable::Scene) != scene || player.findings().size() != findings;
    });
}

TEST(Reload, KeepsCameraAndTimeAndOutlivesABrokenSave) {
    std::string file = testing::TempDir() + "kinora_reload.dae";
    std::string good = text_of(scene_path("scenes/walker.dae"));
    write(file, good);
    Played played(small_request(file), {true, true, nullptr});
    Player& player = played.player;
    ASSERT_TRUE(player.wait_idle(kLong));
    ASSERT_TRUE(player.run_line("orbit 10 5").done);
    ASSERT_TRUE(player.run_line("seek 7").done);
    std::string camera = player.observe(Observable::Camera);
    std::string scene = player.observe(Observable::Scene);

    write(file, good.substr(0, good.size() / 2));
    ASSERT_TRUE(wait_for_news(played, scene, player.findings().size()));
    EXPECT_EQ(player.observe(Observable::Scene), scene);
    EXPECT_EQ(player.load_state(), LoadState::Ready);
    EXPECT_FALSE(player.findings().empty());

    write(file, good);
    ASSERT_TRUE(played.until([&] { return player.observe(Observable::Scene) != scene; }));
    EXPECT_EQ(player.observe(Observable::Camera), camera);
    EXPECT_EQ(player.observe(Observable::Time), "frame 7");
    EXPECT_TRUE(player.wait_idle(kLong));
}

// A picture file that a texture reads.
TEST(Reload, FollowsTextures) {
    const std::string folder = testing::TempDir() + "kinora_reload_texture/";
    std::filesystem::create_directories(folder);
    const auto paint = [&](uint8_t red, uint8_t green) {
        Image8 image{2, 2, {}};
        for (int k = 0; k < 4; ++k) image.rgba.insert(image.rgba.end(), {red, green, 0, 255});
        ASSERT_EQ(write_png(folder + "paint.png", image, {}), "");
    };
    paint(255, 0);
    write(folder + "painted.sl",
          "surface painted() { Ci = color texture(\"paint.png\", 0.5, 0.5); Oi = 1; }");
    write(folder + "matte.dae", text_of(scene_path("scenes/matte.dae")));
    SceneRequest request = small_request(folder + "matte.dae");
    request.shaders.emplace_back("*", folder + "painted.sl");
    Played played(request, {true, true, nullptr});
    Player& player = played.player;
    ASSERT_TRUE(player.wait_idle(kLong));
    const auto reds = [&] {
        const auto picture = player.picture();
        size_t red = 0, green = 0;
        for (size_t k = 0; k < picture->rgba.size(); k += 4) {
            red += picture->rgba[k] > 200 && picture->rgba[k + 1] < 50;
            green += picture->rgba[k] < 50 && picture->rgba[k + 1] > 200;
        }
        return std::pair(red, green);
    };
    EXPECT_GT(reds().first, 100u);
    EXPECT_EQ(reds().second, 0u);
    paint(0, 255);
    ASSERT_TRUE(wait_for_news(played, player.observe(Observable::Scene), player.findings().size()));
    ASSERT_TRUE(player.wait_idle(kLong));
    EXPECT_EQ(reds().first, 0u);
    EXPECT_GT(reds().second, 100u);
    std::filesystem::remove_all(folder);
}

// By Escape. The scene shown keeps its edits, and the next edit is put on it.
TEST(Open, IsLeftAndTheSceneShownStays) {
    Played played(small_request(scene_path("scenes/matte.dae")), {true, false, nullptr});
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material bright; param Kd 0.25; wait refined"), "");
    ASSERT_TRUE(player.run("open", {scene_path("scenes/walker.dae")}).done);
    EXPECT_EQ(player.run("deselect", {}).message, "the scene is not opened");
    ASSERT_TRUE(player.wait_idle(kLong));
    EXPECT_NE(player.scene()->path.find("matte"), std::string::npos);
    const std::vector<uint8_t> pale = player.picture()->rgba;
    EXPECT_EQ(played.script("undo; wait refined"), "");
    EXPECT_NE(player.picture()->rgba, pale);
    EXPECT_EQ(played.script("redo; wait refined"), "");
    EXPECT_EQ(player.picture()->rgba, pale);
}

TEST(Open, NodesWithoutNamesHaveNumbers) {
    Played played("scenes/rays.dae");
    EXPECT_EQ(played.script("select \"#3\""), "");
    EXPECT_EQ(played.player.state().selection.node, "#3");
    EXPECT_NE(played.script("hide").find("neither an id nor a name"), std::string::npos);
}

}  // namespace
}  // namespace kinora
