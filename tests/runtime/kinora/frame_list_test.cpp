// tests/runtime/kinora/frame_list_test.cpp: frame ranges, exact times, numbered names.
#include "runtime/kinora/frame_list.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinora {
namespace {

using Frames = std::vector<int64_t>;

Frames frames(std::string_view text) {
    std::string error;
    auto result = parse_frames(text, error);
    EXPECT_TRUE(result) << text << ": " << error;
    return result.value_or(Frames{});
}

std::string refusal(std::string_view text) {
    std::string error;
    auto result = parse_frames(text, error);
    EXPECT_FALSE(result) << text << " gave " << (result ? result->size() : 0) << " frames";
    return error;
}

TEST(FrameList, ReadsEverySpellingOfARange) {
    const Frames odd = {1, 3, 5, 7, 9};
    for (const char* text : {"1-9x2", "1..9x2", "1:9x2", "1-9:2", "1:9:2", "1..9:2", "1-10x2"})
        EXPECT_EQ(frames(text), odd) << text;
    const Frames all = {4, 5, 6};
    for (const char* text : {"4-6", "4..6", "4:6", "4,5,6", "4-5,6", "4-6x1"})
        EXPECT_EQ(frames(text), all) << text;
    EXPECT_EQ(frames("300"), Frames{300});
    EXPECT_EQ(frames("1-5x2,300,8-6x-1"), (Frames{1, 3, 5, 300, 8, 7, 6}));
}

TEST(FrameList, HasEachFrameOnceAtItsFirstPlace) {
    EXPECT_EQ(frames("1-3,2-4"), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(frames("1-5x2,300,3-1x-1,300"), (Frames{1, 3, 5, 300, 2}));
    EXPECT_EQ(frames("7,7,7"), Frames{7});
}

TEST(FrameList, IsWrittenAsRanges) {
    EXPECT_EQ(frame_ranges({}), "");
    EXPECT_EQ(frame_ranges({7, 31}), "7, 31");
    EXPECT_EQ(frame_ranges({34, 7, 31, 33, 32}), "7, 31-34");
    EXPECT_EQ(frame_ranges({-3, -2, -1, 0}), "-3-0");
    for (const char* text : {"1-240", "5,9,10", "-5--3,0,12"}) {
        std::string ranges = frame_ranges(frames(text));
        std::erase(ranges, ' ');
        EXPECT_EQ(frames(ranges), frames(text)) << text;
    }
}

TEST(FrameList, CountsDownWhenTheEndIsBeforeTheStart) {
    EXPECT_EQ(frames("3-1"), (Frames{3, 2, 1}));
    EXPECT_EQ(frames("10-1x-4"), (Frames{10, 6, 2}));
}

TEST(FrameList, TakesNegativeFramesAndZero) {
    EXPECT_EQ(frames("-5--3"), (Frames{-5, -4, -3}));
    EXPECT_EQ(frames("-1-1"), (Frames{-1, 0, 1}));
    EXPECT_EQ(frames("-2"), Frames{-2});
    EXPECT_EQ(frames("0"), Frames{0});
    EXPECT_EQ(frames("-1..-3"), (Frames{-1, -2, -3}));
}

TEST(FrameList, RefusesWhatIsNoRangeAndSaysWhich) {
    for (const char* text : {"", ",", "1,", "a", "1-", "1-x2", "1..", "1-5x", "1-5y2", "1.5",
                             "1 - 5", "0x10-", "1-2-3", "--5", "99999999999999999999"})
        EXPECT_NE(refusal(text).find('\''), std::string::npos) << text;
    EXPECT_NE(refusal("1-9x0").find("step of 0"), std::string::npos);
}

TEST(FrameList, RefusesARangeThatNamesNoFrame) {
    for (const char* text : {"10-1x1", "1-10x-1", "10-9x2", "1-2x-2", "5-1x100"})
        EXPECT_NE(refusal(text).find("no frame"), std::string::npos) << text;
}

TEST(FrameList, RefusesMoreFramesThanAnyoneRenders) {
    refusal("0-99999999999");
    refusal("1-9000000,1-9000000");
    refusal("-9223372036854775808-9223372036854775807");
    refusal("9223372036854775807");
    refusal("1-9223372036854775807x9223372036854775807");
}

// docs/numerics.md#cameras: an accumulated float sum is hours off there.
TEST(FrameRate, TimesAreExactFractions) {
    FrameRate ntsc = *parse_frame_rate("24000/1001");
    EXPECT_EQ(ntsc.time(10'000'000), double(10'010'000'000.0L / 24000.0L));
    EXPECT_NEAR(ntsc.time(10'000'000), 417083.0 + 1.0 / 3.0, 1e-9);
    EXPECT_EQ(ntsc.time(24000), 1001.0);
    EXPECT_EQ(ntsc.time(-24000), -1001.0);
    EXPECT_EQ(ntsc.time(0), 0.0);
    EXPECT_EQ(parse_frame_rate("25")->time(1), 0.04);
    EXPECT_EQ(parse_frame_rate("30")->time(3), 0.1);
    // The n-th frame is the nearest double to n / fps, whatever came before it.
    FrameRate film = *parse_frame_rate("24");
    for (int64_t n = 0; n < 5000; ++n) EXPECT_EQ(film.time(n), double((long double)(n) / 24.0L));
}

TEST(FrameRate, NtscDecimalsMeanTheirFractions) {
    struct Row {
        const char* text;
        int64_t numerator, denominator;
    };
    for (const Row& row : {Row{"23.976", 24000, 1001}, Row{"23.98", 24000, 1001},
                           Row{"29.97", 30000, 1001}, Row{"59.94", 60000, 1001}, Row{"24", 24, 1},
                           Row{"25.0", 25, 1}, Row{"12.5", 12500, 1000}}) {
        auto rate = parse_frame_rate(row.text);
        ASSERT_TRUE(rate) << row.text;
        EXPECT_EQ(rate->numerator * row.denominator, row.numerator * rate->denominator) << row.text;
    }
}

TEST(FrameRate, RefusesWhatIsNoRate) {
    for (const char* text : {"", "0", "-24", "24/0", "0/1", "24/", "/1", "24/-1", "nan", "inf",
                             "24fps", "1e9", "24 ", "x"})
        EXPECT_FALSE(parse_frame_rate(text)) << text;
}

TEST(FrameRate, NeverEndsAtZero) {
    for (const char* text : {"0.0001", "1e-300", "0.0004"})
        if (auto rate = parse_frame_rate(text)) {
            EXPECT_GT(rate->numerator, 0) << text;
            EXPECT_TRUE(std::isfinite(rate->time(1))) << text;
        }
}

TEST(OutputName, FillsTheFrameToken) {
    EXPECT_EQ(OutputName("out/f.####.exr").file(7), "out/f.0007.exr");
    EXPECT_EQ(OutputName("out/f.#.exr").file(7), "out/f.7.exr");
    EXPECT_EQ(OutputName("f.%04d.png").file(123456), "f.123456.png");
    EXPECT_EQ(OutputName("f%d.png").file(3), "f3.png");
    EXPECT_EQ(OutputName("f.####.png").file(-3), "f.-0003.png");
    EXPECT_EQ(OutputName("f.png").file(9), "f.png");
}

TEST(OutputName, KnowsWhetherItHasAToken) {
    EXPECT_TRUE(OutputName("f.####.exr").has_token());
    EXPECT_TRUE(OutputName("f.%04d.exr").has_token());
    EXPECT_FALSE(OutputName("f.exr").has_token());
    EXPECT_FALSE(OutputName("50%full.exr").has_token());
    EXPECT_FALSE(OutputName("f%sd.exr").has_token());
}

TEST(OutputName, ATokenStandsInTheFileNameNotInItsFolder) {
    EXPECT_FALSE(OutputName("take#2/f.png").has_token());
    EXPECT_EQ(OutputName("take#2/f.%04d.png").file(1), "take#2/f.0001.png");
    EXPECT_EQ(OutputName("100%done/f.##.png").file(1), "100%done/f.01.png");
}

}  // namespace
}  // namespace kinora
