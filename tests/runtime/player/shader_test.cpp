// tests/runtime/player/shader_test.cpp: shaders edited while they are shown, and saved.
#include <algorithm>
#include <fstream>

#include "runtime/player/files/shader_source.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
}

std::vector<uint8_t> pixels(Player& player) {
    EXPECT_TRUE(player.wait_idle(kLong));
    return player.picture()->rgba;
}

constexpr const char* kFrom = "value * (Ka * ambient()";
constexpr const char* kTo = "color(1, 0, 1) * value * (Ka * ambient()";

struct WalkerCopy : testing::Test {
    std::string file = testing::TempDir() + "kinora_play_walker.dae";
    std::string original = text_of(scene_path("scenes/walker.dae"));
    void SetUp() override { write(file, original); }
};

TEST(ShaderSource, XmlHoldsAnyText) {
    for (const std::string& text :
         {std::string("if (a < b && c > d) \"x\" 'y'"), std::string("a ]]> b ]]]>"),
          std::string("\n\tlines\n"), std::string("]]>"), std::string("")})
        for (bool wanted : {true, false}) {
            bool cdata = false;
            std::string xml = xml_text(text, wanted);
            EXPECT_EQ(plain_text(xml, cdata), text);
            EXPECT_EQ(cdata, wanted);
            if (!wanted) {
                EXPECT_EQ(xml.find('<'), std::string::npos);
            }
        }
    bool cdata = false;
    EXPECT_EQ(plain_text("a &lt; b\r\n<![CDATA[c < d\r\ne]]> f &amp; &#", cdata),
              "a < b\nc < d\ne f & &#");
}

// What is typed into the player gives the picture of a file that was written so.
TEST_F(WalkerCopy, AnEditGivesThePictureOfTheEditedFile) {
    Played played(small_request(file));
    std::vector<uint8_t> before = pixels(played.player);
    EXPECT_EQ(played.script("select_material wall-material; edit; find \"value * (Ka\"; "
                            "type \"color(1, 0, 1) * \""),
              "");
    EXPECT_TRUE(played.player.shader().dirty);
    std::vector<uint8_t> edited = pixels(played.player);
    EXPECT_EQ(played.player.shader().shown, played.player.shader().version);
    EXPECT_NE(edited, before);

    write(file, replaced(original, kFrom, kTo));
    Played again(small_request(file));
    EXPECT_EQ(pixels(again.player), edited);
}

// Without derivatives Du is 0, in edited shaders too.
TEST_F(WalkerCopy, AnEditKeepsTheScenesSettings) {
    SceneRequest request = small_request(file);
    request.quality.derivatives = false;
    Played played(request);
    std::vector<uint8_t> before = pixels(played.player);
    EXPECT_EQ(played.script("select_material wall-material; edit; find \"value * (Ka\"; "
                            "type \"(1 + 1000 * abs(xcomp(Du(P)))) * \""),
              "");
    EXPECT_EQ(pixels(played.player), before);
    EXPECT_EQ(played.player.shader().shown, played.player.shader().version);
}

TEST_F(WalkerCopy, SavingChangesTheTextAndNoOtherByte) {
    Played played(small_request(file));
    EXPECT_EQ(played.script("select_material wall-material; edit; find \"value * (Ka\"; "
                            "type \"color(1, 0, 1) * \"; wait refined; save"),
              "");
    EXPECT_EQ(text_of(file), replaced(original, kFrom, kTo));
    EXPECT_FALSE(played.player.shader().dirty);
    std::vector<uint8_t> saved = pixels(played.player);
    Played again(small_request(file));
    EXPECT_EQ(pixels(again.player), saved);
    EXPECT_EQ(again.player.load_state(), LoadState::Ready);
}

TEST_F(WalkerCopy, AFileThatSomeoneElseChangedIsNotOverwritten) {
    Played played(small_request(file));
    EXPECT_EQ(played.script("select_material wall-material; edit; type \"/**/\""), "");
    std::string theirs = replaced(original, "surface plaster(", "surface  plaster(");
    write(file, theirs);
    EXPECT_NE(played.script("save").find("has changed"), std::string::npos);
    EXPECT_EQ(text_of(file), theirs);
}

TEST_F(WalkerCopy, AnErrorIsUnderlinedAndTheLastGoodShaderStays) {
    Played played(small_request(file));
    std::vector<uint8_t> before = pixels(played.player);
    EXPECT_EQ(played.script("select_material wall-material; edit; find ambient; type x"), "");
    EXPECT_EQ(pixels(played.player), before);
    const ShaderDocument& document = played.player.shader();
    EXPECT_LT(document.shown, document.version);
    EXPECT_FALSE(document.compiling);
    ASSERT_FALSE(document.findings.empty());
    const FindingText& finding = document.findings.front();
    EXPECT_EQ(finding.severity, "error");
    EXPECT_EQ(document.text.substr(finding.begin, 8), "xambient");
    EXPECT_EQ(finding.line,
              1 + std::count(document.text.begin(), document.text.begin() + finding.begin, '\n'));
    EXPECT_EQ(played.script("erase"), "");
    EXPECT_EQ(pixels(played.player), before);
    EXPECT_TRUE(document.findings.empty());
    EXPECT_EQ(document.shown, document.version);
    EXPECT_EQ(played.player.load_state(), LoadState::Ready);
}

TEST_F(WalkerCopy, UndoTakesATypedWordBack) {
    Played played(small_request(file));
    std::vector<uint8_t> before = pixels(played.player);
    EXPECT_EQ(played.script("select_material wall-material; edit"), "");
    std::string text = played.player.shader().text;
    EXPECT_EQ(played.script("find \"value * (Ka\"; type \"0\"; type \" * \""), "");
    EXPECT_NE(pixels(played.player), before);
    EXPECT_EQ(played.script("undo"), "");  // both letters were one change
    EXPECT_EQ(played.player.shader().text, text);
    EXPECT_FALSE(played.player.shader().dirty);
    EXPECT_EQ(pixels(played.player), before);
}

TEST_F(WalkerCopy, ParametersAreListedAsDeclared) {
    Played played(small_request(file));
    EXPECT_EQ(played.script("select_material wall-material; edit; param Kd 0.25; wait refined"),
              "");
    const std::vector<ShaderParamInfo>& params = played.player.shader().params;
    ASSERT_EQ(params.size(), 4u);
    EXPECT_EQ(params[1].name, "Kd");
    EXPECT_EQ(params[1].kind, ParamKind::Float);
    EXPECT_EQ(params[1].numbers, std::vector<double>{0.25});
    EXPECT_EQ(params[3].name, "surface_color");
    EXPECT_EQ(params[3].kind, ParamKind::Color);
    EXPECT_EQ(params[3].numbers.size(), 3u);
}

// A document whose embedded shader has an error is shown without it, and mended.
TEST_F(WalkerCopy, OneThatIsBrokenAtLoadIsMended) {
    write(file, replaced(original, "surface plaster(", "surface plaster(("));
    PlayerSetup setup{true, false, nullptr};
    {
        Played refused(small_request(file), setup);
        EXPECT_EQ(refused.player.load_state(), LoadState::Failed);
    }
    setup.shows_broken = true;
    Played played(small_request(file), setup);
    Player& player = played.player;
    ASSERT_EQ(player.load_state(), LoadState::Ready);
    auto errors = [&] {
        return std::ranges::count(player.findings(), std::string("error"), &FindingText::severity);
    };
    EXPECT_GE(errors(), 1);
    EXPECT_EQ(played.script("select_material wall-material; edit"), "");
    EXPECT_NE(player.shader().text.find("surface plaster(("), std::string::npos);
    EXPECT_EQ(played.script("find \"((\"; erase 1; wait refined"), "");
    EXPECT_EQ(player.shader().shown, player.shader().version);
    EXPECT_EQ(errors(), 0);
    EXPECT_EQ(played.script("save; wait refined"), "");
    EXPECT_EQ(text_of(file), original);
    EXPECT_EQ(errors(), 0);
    Played again(small_request(file));
    EXPECT_EQ(pixels(player), pixels(again.player));
}

TEST(Shader, OneOfOursIsSavedElsewhere) {
    Played played("gltf/bender.glb");
    std::string to = testing::TempDir() + "kinora_play_ours.sl";
    EXPECT_EQ(played.script("select_material clay; edit"), "");
    EXPECT_NE(played.player.shader().text.find("surface gltf_pbr"), std::string::npos);
    EXPECT_NE(played.script("save").find("one of ours"), std::string::npos);
    EXPECT_EQ(played.script("save " + to), "");
    EXPECT_EQ(text_of(to), played.player.shader().text);
}

TEST(Shader, OneThatLoopsForEverIsLeftBehind) {
    Played played(small_request(scene_path("scenes/matte.dae")), {true, false, nullptr});
    Player& player = played.player;
    std::vector<uint8_t> before = pixels(player);
    EXPECT_EQ(played.script("select_material bright; edit"), "");
    std::string text = player.shader().text;
    uint64_t frames = player.frames_rendered();
    ASSERT_TRUE(player
                    .run("set_text", {"surface a(float Ka = 1, Kd = 1) {\n"
                                      "    float k = 0; while (1) k += 1; Ci = k; Oi = 1; }"})
                    .done);
    ASSERT_TRUE(played.until([&] { return player.frames_rendered() > frames; }));
    ASSERT_TRUE(player.run("set_text", {text}).done);
    EXPECT_EQ(pixels(player), before);
}

// Edits by a fixed generator, good and broken, while it plays.
TEST(Shader, AHundredRandomEditsLeaveItWell) {
    Played played(small_request(scene_path("scenes/matte.dae")), {true, false, nullptr});
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material bright; edit; play on"), "");
    std::string text = player.shader().text;
    const char* pieces[] = {"(", ";", "}", "Ci", "= 3", "\"", "while (1)", "normal", "#", " "};
    uint32_t state = 7;
    for (int k = 0; k < 100; ++k) {
        state = state * 1664525u + 1013904223u;
        std::string edited = text;
        edited.insert(state % text.size(), pieces[(state >> 16) % std::size(pieces)]);
        ASSERT_TRUE(player.run("set_text", {edited}).done);
        player.advance(0.01);
        if (k % 10 == 0) {
            EXPECT_TRUE(player.wait_picture(kLong));
        }
    }
    EXPECT_TRUE(player.run("set_text", {text}).done);
    EXPECT_TRUE(player.run_line("play off").done);
    EXPECT_TRUE(player.wait_idle(kLong));
    EXPECT_EQ(player.shader().shown, player.shader().version);
    EXPECT_TRUE(player.picture()->refined);
}

// The editor's own ranges, a scene's file at the shader's line, and a file that is no shader's.
TEST_F(WalkerCopy, FindingsLeadToTheirPlaces) {
    Played played(small_request(file));
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material wall-material; edit; find \"value * (Ka\";"
                            "type \"valeu + \"; caret 1 1; wait refined; finding 1"),
              "");
    const ShaderDocument& shader = player.shader();
    EXPECT_EQ(shader.text.substr(shader.caret, 5), "valeu");
    EXPECT_EQ(player.state().raised.name, "editor");
    EXPECT_NE(played.script("finding 99"), "");
    EXPECT_EQ(played.script("undo; wait refined"), "");
}

TEST(Findings, OfTheScenesFileLeadToTheShaderOrTheLine) {
    const std::string file = testing::TempDir() + "kinora_play_findings.dae";
    std::string text = text_of(scene_path("scenes/walker.dae"));
    // Something to warn of in a shader, and in the document.
    text = replaced(text, kFrom, "(0 * log(0 - 1) + value) * (Ka * ambient()");
    text = replaced(text, "<library_cameras>", "<library_nonsense/>\n<library_cameras>");
    write(file, text);
    Played played(small_request(file));
    Player& player = played.player;
    ASSERT_TRUE(player.wait_idle(kLong));
    bool led_to_line = false;
    for (size_t k = 0; k < player.findings().size(); ++k) {
        const FindingText finding = player.findings()[k];
        if (finding.file != file) continue;
        ASSERT_TRUE(player.run("finding", {std::to_string(k + 1)}).done);
        if (finding.message.find("library_nonsense") == std::string::npos) continue;
        led_to_line = true;
        EXPECT_EQ(player.state().raised.name, "source");
        EXPECT_EQ(player.state().place.file, file);
        EXPECT_EQ(player.state().place.line, finding.line);
    }
    EXPECT_TRUE(led_to_line);
    EXPECT_EQ(played.script("key F8"), "");  // the next one, round and round
}

// All that wear shaders of one text change with it: a surface and a displacement beside it.
TEST(Texts, OfSeveralShadersAreOne) {
    const std::string file = testing::TempDir() + "kinora_play_two.dae";
    std::string text = text_of(scene_path("scenes/matte.dae"));
    text = replaced(text, "]]></code>",
                    "displacement bumps(float height = 0) { P += height * normalize(N); }\n"
                    "]]></code>");
    text = replaced(text, "<shader stage=\"SURFACE\">",
                    "<shader stage=\"DISPLACEMENT\"><name>bumps</name></shader>\n"
                    "<shader stage=\"SURFACE\">");
    write(file, text);
    Played played(small_request(file));
    Player& player = played.player;
    const std::vector<uint8_t> before = pixels(player);
    ASSERT_TRUE(player.scene());
    EXPECT_EQ(played.script("select_material bright:displacement; edit"), "");
    EXPECT_EQ(player.shader().material, "bright:displacement");
    ASSERT_EQ(player.shader().params.size(), 1u);
    EXPECT_EQ(player.shader().params[0].name, "height");
    EXPECT_EQ(played.script("param height 0.4"), "");
    EXPECT_NE(pixels(player), before);
    EXPECT_EQ(played.script("undo; find \"0) { P\"; erase 1; type 0.4"), "");
    const std::string higher = replaced(text, "height = 0)", "height = 0.4)");
    write(testing::TempDir() + "kinora_play_higher.dae", higher);
    Played other(small_request(testing::TempDir() + "kinora_play_higher.dae"));
    EXPECT_EQ(pixels(player), pixels(other.player)) << player.shader().text;
    EXPECT_EQ(played.script("select_material bright; edit"), "");
    EXPECT_NE(player.shader().text.find("height = 0.4"), std::string::npos);
    EXPECT_EQ(played.script("find \"Kd * diffuse\"; type \"0.5 * \"; wait refined; save"), "");
    const std::vector<uint8_t> both = pixels(player);
    EXPECT_EQ(text_of(file), replaced(higher, "Kd * diffuse", "0.5 * Kd * diffuse"));
    Played again(small_request(file));
    EXPECT_EQ(pixels(again.player), both);
    EXPECT_NE(both, pixels(other.player));
}

// A light's shader and its parameters, while it shines.
TEST(Texts, OfLightsAreEdited) {
    Played played("scenes/court.dae");
    Player& player = played.player;
    const std::vector<uint8_t> before = pixels(player);
    std::string light;
    for (const MaterialInfo& material : player.scene()->materials)
        if (material.further && material.id.starts_with("light:")) light = material.id;
    ASSERT_NE(light, "");
    EXPECT_EQ(played.script("select_material \"" + light + "\"; edit"), "");
    ASSERT_TRUE(player
                    .run("set_text", {"light green() { illuminate(point (0, 50, 0))"
                                      " Cl = color(0, 4, 0); }"})
                    .done);
    EXPECT_NE(pixels(player), before);
    EXPECT_TRUE(player.shader().findings.empty());
    EXPECT_EQ(played.script("undo"), "");
    EXPECT_EQ(pixels(player), before);
    ASSERT_TRUE(player.run("set_text", {"surface green() { Ci = 1; Oi = 1; }"}).done);
    EXPECT_EQ(pixels(player), before);  // of another kind
    EXPECT_FALSE(player.findings().empty());
}

// Another shader of ours goes on the chosen material alone.
TEST(Texts, BoundOnesAreTheirWearersAlone) {
    Played played("scenes/walker.dae");
    Player& player = played.player;
    EXPECT_EQ(played.script("select_material wall-material; bind metal; wait refined"), "");
    for (const MaterialInfo& material : player.scene()->materials) {
        if (material.id == "wall-material") {
            EXPECT_EQ(material.shader, "metal");
        }
        if (material.id == "trim-material") {
            EXPECT_EQ(material.shader, "plaster");
        }
    }
    EXPECT_EQ(played.script("select_material trim-material; edit"), "");
    EXPECT_NE(player.shader().text.find("surface plaster"), std::string::npos);
}

}  // namespace
}  // namespace kinora
