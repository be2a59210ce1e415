// tests/runtime/play/reload_test.cpp: files that change while they are shown.
#include <fstream>

#include "tests/runtime/play/played.h"

namespace kinora {
namespace {

// Until the scene shown or the findings are other ones.
bool wait_for_news(Player& player, const std::string& scene, size_t findings) {
    for (int k = 0; k < 3000; ++k) {
        player.advance(0.01);
        if (player.observe(Observable::Scene) != scene || player.findings().size() != findings)
            return true;
        usleep(10000);
    }
    return false;
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
    ASSERT_TRUE(wait_for_news(player, scene, player.findings().size()));
    EXPECT_EQ(player.observe(Observable::Scene), scene);
    EXPECT_EQ(player.load_state(), LoadState::Ready);
    EXPECT_FALSE(player.findings().empty());

    write(file, good);
    ASSERT_TRUE(wait_for_news(player, scene, 1 << 20));
    for (int k = 0; k < 3000 && player.observe(Observable::Scene) == scene; ++k) {
        player.advance(0);
        usleep(10000);
    }
    EXPECT_NE(player.observe(Observable::Scene), scene);
    EXPECT_EQ(player.observe(Observable::Camera), camera);
    EXPECT_EQ(player.observe(Observable::Time), "frame 7");
    EXPECT_TRUE(player.wait_idle(kLong));
}

}  // namespace
}  // namespace kinora
