// tests/runtime/player/commands_test.cpp: every row of the table changes what it says it does.
#include "runtime/player/commands.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "runtime/base/stats.h"
#include "runtime/player/state.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/quality/knobs.h"
#include "tests/folders.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

// All numbers of a text, parted by spaces.
std::string numbers_of(std::string text) {
    for (size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        const bool of_number = (c >= '0' && c <= '9') || c == '.' || c == '-' ||
                               (c == 'e' && k > 0 && text[k - 1] >= '0' && text[k - 1] <= '9');
        if (!of_number) text[k] = ' ';
    }
    return text;
}

class EveryCommand : public testing::TestWithParam<Command> {};

TEST_P(EveryCommand, ChangesWhatItsRowSays) {
    const Command& row = GetParam();
    ASSERT_EQ(chdir(project_folder().c_str()), 0);
    bool clips = std::string_view(row.word) == "clip";  // of all scenes one has some
    Played played(clips ? "gltf/bender.glb" : "scenes/walker.dae");
    ASSERT_EQ(played.script(row.setup), "");
    std::string example = row.example;
    if (size_t at = example.find("$TMP/"); at != example.npos)
        example.replace(at, 5, testing::TempDir());
    ASSERT_TRUE(played.player.wait_idle(kLong));
    std::string before = played.player.observe(row.changes);
    CommandResult result = played.player.run_line(std::string(row.word) + " " + example);
    ASSERT_TRUE(result.done) << result.message;
    ASSERT_TRUE(played.player.wait_idle(kLong));
    EXPECT_NE(played.player.observe(row.changes), before);
}

INSTANTIATE_TEST_SUITE_P(All, EveryCommand, testing::ValuesIn(commands().begin(), commands().end()),
                         [](const auto& row) { return std::string(row.param.word); });

TEST(Commands, HaveKeysAndWordsOfTheirOwn) {
    std::set<std::string> words, keys, menus;
    for (const Command& row : commands()) {
        EXPECT_TRUE(words.insert(row.word).second) << row.word;
        EXPECT_EQ(find_command(row.word), &row);
        EXPECT_FALSE(std::string_view(row.help).empty()) << row.word;
        if (*row.menu) {
            EXPECT_TRUE(menus.insert(row.menu).second) << row.menu;
        }
        std::istringstream each(row.key);
        for (std::string key; each >> key;) {
            EXPECT_TRUE(keys.insert(key).second) << key;
            EXPECT_EQ(find_command_of_key(key), &row);
        }
    }
    EXPECT_EQ(find_command("orbitt"), nullptr);
    EXPECT_EQ(find_command_of_key("Shift"), nullptr);
}

TEST(Commands, SwitchWhatThePlayersKnobsName) {
    EXPECT_GE(play_knobs().size(), 2u);
    for (const PlayKnob& knob : play_knobs()) {
        const Command* command = find_command(knob.command);
        ASSERT_TRUE(command) << knob.command;
        EXPECT_EQ(command->changes, Observable::Picture);
        EXPECT_EQ(command->arguments, std::string()) << "a switch";
        EXPECT_NE(std::ranges::find(knob.settings, knob.begin), knob.settings.end());
    }
    const PictureState begin;
    auto word = [](bool on) { return on ? "on" : "off"; };
    EXPECT_EQ(play_knobs()[0].begin, word(begin.adapt));
    EXPECT_EQ(play_knobs()[1].begin, word(begin.filter));
}

TEST(Commands, SplitLinesIntoWords) {
    Words words = split_words("  param Kd \"0.5 \\\"a\\\" \\n\" # why");
    ASSERT_EQ(words.texts.size(), 3u);
    EXPECT_EQ(words.texts[2], "0.5 \"a\" \n");
    EXPECT_EQ(words.columns, (std::vector<int>{3, 9, 12}));
    EXPECT_FALSE(split_words("say \"no").error.empty());
    EXPECT_TRUE(split_words(" # nothing").texts.empty());
}

TEST(Script, SaysWhereItStopsAndWhatMayBeMeant) {
    Played played("scenes/matte.dae");
    EXPECT_EQ(played.script("seek 0;  orbitt 3 4"),
              "test:2:3: error: there is no command 'orbitt'; did you mean 'orbit'?");
    EXPECT_EQ(played.script("orbit 3 up"), "test:1:9: error: 'up' is no number");
    EXPECT_EQ(played.script("orbit 3"), "test:1:7: error: orbit takes right:number up:number");
    EXPECT_EQ(played.script("select lefft"),
              "test:1:8: error: there is no node 'lefft'; did you mean 'left'?");
    EXPECT_EQ(played.script("seek 2; expect time 3"), "test:2:14: error: the frame is 2, not 3");
    EXPECT_NE(played.script("wait forever").find("test:1:6: error: wait takes"), std::string::npos);
}

TEST(Script, TimeRunsInStepsThatAreAlwaysTheSame) {
    for (int turn = 0; turn < 2; ++turn) {
        Played played("scenes/walker.dae");
        EXPECT_EQ(played.script("first; play on; wait 0.5; pause; expect time 13"), "");
    }
}

TEST(Script, KeysDoWhatTheirRowsSay) {
    Played played("scenes/walker.dae");
    EXPECT_EQ(played.script("seek 5; key Right; expect time 6; key Home; expect time 1;"
                            "key Space; expect playback plays"),
              "");
}

TEST(Script, PixelsAreExpectedWithinATolerance) {
    Played played("scenes/matte.dae");
    played.player.wait_idle(kLong);
    const uint8_t* p = &played.player.picture()->rgba[4 * (18 * 64 + 20)];
    auto line = [&](int off, const char* tolerance) {
        return "expect pixel 20 18 " + std::to_string(p[0] + off) + " " + std::to_string(p[1]) +
               " " + std::to_string(p[2]) + tolerance;
    };
    EXPECT_EQ(played.script(line(0, "")), "");
    EXPECT_EQ(played.script(line(3, " 3")), "");
    EXPECT_NE(played.script(line(3, " 2")), "");
    EXPECT_NE(played.script("expect pixel 64 0 0 0 0"), "");
}

TEST(Script, RecordsWhatItCanRunAgain) {
    std::string file = testing::TempDir() + "kinora_recorded.txt";
    std::string camera;
    {
        Played played("scenes/walker.dae");
        ASSERT_TRUE(played.player.record_to(file));
        EXPECT_EQ(played.script("orbit 30 10; play on; wait 0.25; pause; panel \"A \\\"b\\\"\""),
                  "");
        camera = played.player.observe(Observable::Camera);
    }
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    Played again("scenes/walker.dae");
    EXPECT_EQ(again.script(text + "\nexpect time 7"), "");
    EXPECT_EQ(again.player.observe(Observable::Camera), camera);
    EXPECT_EQ(again.player.observe(Observable::Panels), "A \"b\"");
}

// By the clock, with a camera that keys move: what is recorded leads to the same state without a
// clock. The picture that the camera was taken from may be of an earlier time.
TEST(Script, ARecordOfTheClockLeadsToTheSameState) {
    const std::string file = testing::TempDir() + "kinora_recorded_clock.txt";
    std::string camera, time, playback;
    {
        Played played(small_request(scene_path("scenes/court.dae")), {true, false, nullptr});
        Player& player = played.player;
        ASSERT_TRUE(player.record_to(file));
        ASSERT_TRUE(player.wait_picture(kLong));
        Script script(player, "clock", [](const std::string& line) { ADD_FAILURE() << line; });
        ASSERT_TRUE(
            script.run("play on\nwait 0.37\norbit 20 3\nturntable\nwait 0.21\ndolly 1.2\n"
                       "loop pingpong\nwait 0.3\nevery_frame\nwait 0.2\npause\n"));
        camera = player.observe(Observable::Camera);
        time = player.observe(Observable::Time);
        playback = player.observe(Observable::Playback);
    }
    Played again("scenes/court.dae");
    EXPECT_EQ(again.script(text_of(file)), "");
    EXPECT_EQ(again.player.observe(Observable::Time), time);
    EXPECT_EQ(again.player.observe(Observable::Playback), playback);
    const std::string replayed = again.player.observe(Observable::Camera);
    EXPECT_EQ(replayed.substr(0, replayed.find("eye")), camera.substr(0, camera.find("eye")));
    // Turned in other steps: equal but for rounding.
    std::istringstream a(numbers_of(camera)), b(numbers_of(replayed));
    double x = 0, y = 0;
    int count = 0;
    while (a >> x && b >> y) {
        EXPECT_NEAR(x, y, 1e-6 * (1 + std::abs(x)));
        ++count;
    }
    EXPECT_GE(count, 14);
}

TEST(Script, ACameraStandsAsNumbersSay) {
    Played played("scenes/matte.dae");
    EXPECT_EQ(played.script("orbit 20 10"), "");
    const std::string camera = played.player.observe(Observable::Camera);
    const std::string text = camera_text(played.player.state().camera.own);
    EXPECT_EQ(played.script("camera; stand \"" + text + "\""), "");
    EXPECT_EQ(played.player.observe(Observable::Camera), camera);
    EXPECT_NE(played.script("stand \"0 0 0  1  1 0 0  1 0 0  0 0 1\""), "");  // not at right angles
    EXPECT_NE(played.script("stand \"0 0 0 1\""), "");
}

// As a window runs them: each step returns at once, and says whether the line is done.
TEST(Script, StepsDoNotWait) {
    Played played(small_request(scene_path("scenes/walker.dae")), {true, false, nullptr});
    std::string said;
    Script script(played.player, "steps", [&](const std::string& line) { said += line; });
    using enum Script::Progress;
    EXPECT_EQ(script.step("seek 5  # a frame"), Done);
    EXPECT_EQ(script.step(""), Done);
    int turns = 0;
    EXPECT_TRUE(played.until([&] {
        const bool waits = script.step("wait refined") == Waits;
        turns += waits;
        return !waits;
    }));
    EXPECT_GT(turns, 0);
    EXPECT_TRUE(played.player.picture()->refined);
    EXPECT_EQ(script.step("wait 1000"), Waits);
    EXPECT_EQ(script.step("wait 1000"), Waits);
    Script other(played.player, "steps", [&](const std::string& line) { said += line; });
    EXPECT_EQ(other.step("wait 0"), Done);
    EXPECT_EQ(other.step("expect time 5"), Done);
    EXPECT_EQ(said, "");
    EXPECT_EQ(other.step("wait forever"), Failed);
    EXPECT_EQ(said.substr(0, 29), "steps:3:6: error: wait takes ");
    EXPECT_EQ(other.step("orbit \"3"), Failed);
}

// Each turn moves the clock on, as a window's do: what is awaited is a picture of the wait's
// beginning or later, and not one of a moment that is over when it comes.
TEST(Script, APictureComesWhileTheSceneGoesOn) {
    Played played(small_request(scene_path("scenes/walker.dae")), {true, false, nullptr});
    std::string said;
    Script script(played.player, "steps", [&](const std::string& line) { said += line; });
    using enum Script::Progress;
    ASSERT_TRUE(played.player.wait_idle(60));
    const uint64_t still = played.player.picture()->serial;
    ASSERT_EQ(script.step("play"), Done);
    EXPECT_TRUE(played.until([&] { return script.step("wait picture") != Waits; }, 0.001));
    EXPECT_NE(played.player.picture()->serial, still);
    EXPECT_EQ(said, "");
}

// The time moves so often that another picture is always wanted before one is made.
TEST(Script, AClickIsAnsweredWhileTheSceneGoesOn) {
    Played played(small_request(scene_path("scenes/walker.dae")), {true, false, nullptr});
    std::string said;
    Script script(played.player, "steps", [&](const std::string& line) { said += line; });
    using enum Script::Progress;
    ASSERT_TRUE(played.player.wait_idle(60));
    ASSERT_EQ(script.step("play"), Done);
    ASSERT_EQ(script.step("click 32 18"), Done);
    const Stopwatch watch;
    while (script.step("wait picture") == Waits && watch.ms() < 60'000)
        played.player.advance(0.00001);
    EXPECT_LT(watch.ms(), 60'000);
    EXPECT_NE(played.player.state().selection.node, "");
    EXPECT_EQ(said, "");
}

TEST(Script, StateIsWrittenAsItIsObserved) {
    Played played("scenes/walker.dae");
    std::string file = testing::TempDir() + "kinora_play_state.json";
    EXPECT_EQ(played.script("seek 7; select_material wall-material; param Kd 0.5; state " + file),
              "");
    std::string text = text_of(file);
    EXPECT_NE(text.find("\"time\": \"frame 7\""), std::string::npos) << text.substr(0, 600);
    EXPECT_NE(text.find("\"edits\": \"param wall-material.Kd 0.5\\u000a\""), std::string::npos);
    for (const ObservableRow& row : observables())
        EXPECT_NE(text.find("\"" + std::string(row.name) + "\": "), std::string::npos) << row.name;
    EXPECT_NE(played.script("state /proc/none/a.json").find("cannot be written"),
              std::string::npos);
}

TEST(Pick, NamesWhatIsThere) {
    Played played("scenes/matte.dae");
    EXPECT_EQ(played.script("view_front; frame_all; click 32 18"), "");
    bool left = false, right = false;
    for (int x = 0; x < 64; x += 2) {
        EXPECT_EQ(played.script("click " + std::to_string(x) + " 18"), "");
        const auto& pixel = played.player.state().selection.pixel;
        ASSERT_TRUE(pixel.has_value());
        if (!pixel->hit) continue;
        left |= pixel->node == "left";
        right |= pixel->node == "right";
        EXPECT_EQ(pixel->shader, "matte");
        EXPECT_NEAR(pixel->N.x * pixel->N.x + pixel->N.y * pixel->N.y + pixel->N.z * pixel->N.z, 1,
                    1e-6);
    }
    EXPECT_TRUE(left && right);
    EXPECT_EQ(played.script("click 0 0"), "");
    EXPECT_FALSE(played.player.state().selection.pixel->hit);
}

TEST(Edits, UndoBringsThePictureBack) {
    Played played("scenes/matte.dae");
    auto pixels = [&] {
        EXPECT_TRUE(played.player.wait_idle(kLong));
        return played.player.picture()->rgba;
    };
    std::vector<uint8_t> first = pixels();
    EXPECT_EQ(played.script("select_material bright; param Kd 0.1"), "");
    std::vector<uint8_t> changed = pixels();
    EXPECT_NE(changed, first);
    EXPECT_EQ(played.script("undo"), "");
    EXPECT_EQ(pixels(), first);
    EXPECT_EQ(played.script("redo"), "");
    EXPECT_EQ(pixels(), changed);
    EXPECT_EQ(played.script("hide left"), "");
    EXPECT_NE(pixels(), changed);
}

// One drag is one change, however many steps it has.
TEST(Edits, UndoTakesAWholeDragBack) {
    Played played("scenes/matte.dae");
    const std::string before = played.player.observe(Observable::Scene);
    EXPECT_EQ(played.script("select_material bright; param Kd 0.9; param Kd 0.1;"
                            "param Kd 0.2 further; param Kd 0.3 further; param Ka 0.5 further;"
                            "wait refined; undo; wait refined"),
              "");
    const auto value = [&](const std::string& name) {
        for (const MaterialInfo& material : played.player.scene()->materials)
            for (const ShaderParamInfo& param : material.params)
                if (material.id == "bright" && param.name == name) return param.numbers.front();
        return -1.0;
    };
    EXPECT_EQ(value("Kd"), 0.3);
    EXPECT_EQ(played.script("undo; wait refined"), "");
    EXPECT_EQ(value("Kd"), 0.9);
    EXPECT_NE(played.script("param Kd 0.1 farther"), "");
}

TEST(Edits, ABadValueKeepsTheLastGoodScene) {
    Played played("scenes/matte.dae");
    EXPECT_TRUE(played.player.wait_idle(kLong));
    std::vector<uint8_t> first = played.player.picture()->rgba;
    std::string scene = played.player.observe(Observable::Scene);
    EXPECT_EQ(played.script("select_material bright; param Kdd 0.1"), "");
    EXPECT_TRUE(played.player.wait_idle(kLong));
    EXPECT_EQ(played.player.observe(Observable::Scene), scene);
    EXPECT_EQ(played.player.picture()->rgba, first);
    bool told = false;
    for (const FindingText& finding : played.player.findings())
        told |= finding.code == "PARAM_UNKNOWN";
    EXPECT_TRUE(told);
}

}  // namespace
}  // namespace kinora
