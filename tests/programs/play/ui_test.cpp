// tests/programs/play/ui_test.cpp: the window's content, drawn in memory, and what it remembers.
#include "runtime/programs/play/ui/ui.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace kinora::play {
namespace {

TEST(Layout, IsReadAsItWasWritten) {
    const std::string file = testing::TempDir() + "kinora_layout/a/play.conf";
    Layout layout;
    layout.width = 1000;
    layout.maximized = true;
    layout.scale = 1.25f;
    layout.sizes[1] = 300;
    layout.front[2] = "times";
    layout.panels = {"scene", "hud"};
    ASSERT_TRUE(write_layout(file, layout));
    const Layout read = read_layout(file);
    EXPECT_EQ(read.width, 1000);
    EXPECT_TRUE(read.maximized);
    EXPECT_EQ(read.scale, 1.25f);
    EXPECT_EQ(read.sizes[1], 300);
    EXPECT_EQ(read.front[2], "times");
    EXPECT_EQ(read.panels, layout.panels);
    EXPECT_TRUE(read.has_panels);
    std::filesystem::remove_all(testing::TempDir() + "kinora_layout");
}

TEST(Layout, WhatIsOutOfRangeKeepsItsDefault) {
    const std::string file = testing::TempDir() + "kinora_bad_play.conf";
    std::ofstream(file)
        << "width -3\nheight x\nscale 99\nleft nan\nright 1e9\nnonsense 1\n\nbottom 200\n";
    const Layout read = read_layout(file), usual;
    EXPECT_EQ(read.width, usual.width);
    EXPECT_EQ(read.height, usual.height);
    EXPECT_EQ(read.scale, usual.scale);
    EXPECT_EQ(read.sizes[0], usual.sizes[0]);
    EXPECT_EQ(read.sizes[1], usual.sizes[1]);
    EXPECT_EQ(read.sizes[2], 200);
    EXPECT_FALSE(read.has_panels);
    EXPECT_FALSE(write_layout("", usual));
    EXPECT_FALSE(write_layout("/proc/no/such/play.conf", usual));
    std::filesystem::remove(file);
}

TEST(Numbers, AreShort) {
    EXPECT_EQ(short_number(12), "12");
    EXPECT_EQ(short_number(0.5), "0.5");
    EXPECT_EQ(short_number(-0.0001), "0");
    EXPECT_EQ(short_number(29.97), "29.97");
}

// Names of nodes and materials come in the letters of their writers.
TEST(Fonts, HaveLettersBeyondLatin) {
    Letters letters;
    EXPECT_TRUE(letters.add("\u0142 \u0436 \u03bb"));
    ImGui::CreateContext();
    const Fonts fonts = load_fonts(1, letters);
    unsigned char* texels;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
    for (ImWchar letter : {u'A', u'\u00e9', u'\u0142', u'\u0436', u'\u03bb', u'\u2192'})
        for (const ImFont* font : {fonts.text, fonts.mono}) {
            EXPECT_TRUE(!fonts.found || font->FindGlyphNoFallback(letter))
                << std::hex << unsigned(letter);
        }
    ImGui::DestroyContext();
    if (!fonts.found) GTEST_SKIP() << "DejaVu is not installed";
}

// DejaVu has Armenian and Georgian, which are loaded once a name needs them.
TEST(Fonts, TakeTheLettersThatNamesNeed) {
    ImGui::CreateContext();
    Letters letters;
    EXPECT_FALSE(letters.add("plain, \u00e9"));
    EXPECT_TRUE(letters.add("\u0540\u0561\u0575 \u10e5\u10d0"));
    EXPECT_FALSE(letters.add("\u0540"));
    EXPECT_FALSE(letters.add("\xff\xc3"));  // no UTF-8
    EXPECT_EQ(letters.all().size(), 5u);
    const Fonts plain = load_fonts(1, {});
    EXPECT_FALSE(plain.found && plain.text->FindGlyphNoFallback(u'\u0540'));
    const Fonts fonts = load_fonts(1, letters);
    for (const ImWchar letter : letters.all()) {
        EXPECT_TRUE(!fonts.found || fonts.text->FindGlyphNoFallback(letter)) << int(letter);
    }
    EXPECT_TRUE(!fonts.found || fonts.mono->FindGlyphNoFallback(u'A'));
    ImGui::DestroyContext();
    if (!fonts.found) GTEST_SKIP() << "DejaVu is not installed";
}

TEST(Fonts, RangesAreThoseOfNeighbours) {
    EXPECT_EQ(ranges_of({}), std::vector<ImWchar>{0});
    EXPECT_EQ(ranges_of({5, 6, 7, 9}), (std::vector<ImWchar>{5, 7, 9, 9, 0}));
}

class Drawn : public testing::Test {
  protected:
    Drawn()
        : player_([] {
              PlayerSetup setup;
              setup.real_time = false;
              setup.watch_files = false;
              return setup;
          }()) {
        ImGui::CreateContext();
        ImGui::GetIO().DisplaySize = {kWidth, kHeight};
        ui_ = std::make_unique<Ui>(player_, Layout(), 1.0f, true);
        turn();
    }
    ~Drawn() override {
        ui_.reset();
        ImGui::DestroyContext();
    }
    void turn(int count = 3) {
        for (int i = 0; i < count; ++i)
            ui_->render({pixels_.data(), kWidth, kHeight, kWidth}, 0.02f);
    }
    bool open(const char* panel) {
        const auto& panels = player_.state().panels;
        return std::find(panels.begin(), panels.end(), panel) != panels.end();
    }
    size_t differing(const std::vector<uint32_t>& before) const {
        size_t count = 0;
        for (size_t i = 0; i < pixels_.size(); ++i) count += pixels_[i] != before[i];
        return count;
    }

    static constexpr int kWidth = 1000, kHeight = 640;
    Player player_;
    std::unique_ptr<Ui> ui_;
    std::vector<uint32_t> pixels_ = std::vector<uint32_t>(kWidth * kHeight);
};

TEST_F(Drawn, CoversTheWholeWindow) {
    const std::vector<uint32_t> first = pixels_;
    std::fill(pixels_.begin(), pixels_.end(), 0xffff00ffu);
    turn(1);
    EXPECT_EQ(differing(first), 0u) << "a frame does not depend on the one before";
    EXPECT_GT(std::set<uint32_t>(first.begin(), first.end()).size(), 50u) << "text has soft edges";
}

TEST_F(Drawn, KeysOfTheTableRunTheirRows) {
    const auto before = pixels_;
    EXPECT_TRUE(ui_->press("H"));
    turn();
    EXPECT_TRUE(open("keys"));
    EXPECT_GT(differing(before), 20000u);
    EXPECT_TRUE(ui_->press("H"));
    turn();
    EXPECT_EQ(differing(before), 0u);
    EXPECT_FALSE(ui_->press("Ctrl+Alt+Shift+F12"));
}

TEST_F(Drawn, LettersBelongToTheTextThatHasTheKeyboard) {
    EXPECT_TRUE(ui_->press("Ctrl+P"));
    turn();
    EXPECT_TRUE(ui_->wants_text());
    EXPECT_FALSE(ui_->press("H"));
    EXPECT_FALSE(open("keys"));
    EXPECT_TRUE(ui_->press("F11"));
    EXPECT_TRUE(open("full_screen"));
    EXPECT_TRUE(ui_->press("Ctrl+P"));  // the same key closes it
    turn();
    EXPECT_FALSE(open("commands"));
    EXPECT_TRUE(ui_->press("H"));
}

TEST_F(Drawn, EveryPanelOpensAndClosesWithItsRow) {
    for (const Command& command : commands()) {
        if (std::string(command.menu).substr(0, 7) != "Window/") continue;
        SCOPED_TRACE(command.word);
        const std::string before = player_.observe(Observable::Panels);
        ASSERT_TRUE(ui_->press(command.key));
        turn();
        EXPECT_NE(player_.observe(Observable::Panels), before);
        ASSERT_TRUE(ui_->press(command.key));
        turn();
    }
}

TEST_F(Drawn, TheSmallestWindowsAreDrawn) {
    for (auto [width, height] : {std::pair{480, 320}, {100, 60}, {1, 1}}) {
        ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        for (int i = 0; i < 3; ++i) ui_->render({pixels_.data(), width, height, width}, 0.02f);
    }
}

TEST_F(Drawn, AFaultIsToldForAWhile) {
    EXPECT_LT(ui_->next_turn(), 0.5);
    ui_->context().run_line("no_such_word");
    EXPECT_TRUE(ui_->context().toast.fault);
    EXPECT_GT(ui_->next_turn(), 4);
    const auto before = pixels_;
    turn(1);
    EXPECT_GT(differing(before), 1000u);
}

}  // namespace
}  // namespace kinora::play
