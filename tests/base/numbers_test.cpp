// tests/base/numbers_test.cpp: numbers of texts, in every locale that the machine has.
#include "runtime/base/numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <string>

namespace kinora {
namespace {

TEST(Numbers, AreTakenOffTheFrontOfATextWithTheSpacesBeforeThem) {
    std::string_view text = " \t2.5e1,rest";
    EXPECT_EQ(take_number<double>(text), 25.0);
    EXPECT_EQ(text, ",rest");
    EXPECT_FALSE(take_number<double>(text));
    EXPECT_EQ(text, ",rest");
}

TEST(Numbers, OfWholeTexts) {
    EXPECT_EQ(number_of<double>("+.5"), 0.5);
    EXPECT_EQ(number_of<int>("-12"), -12);
    EXPECT_EQ(number_of<float>("0.1"), 0.1f);
    EXPECT_TRUE(std::isinf(*number_of<double>("inf")));
    for (const char* none : {"", " ", "+", "+-1", "1 ", "1x", "0x10", "1,5", "1e999", "--1"})
        EXPECT_FALSE(number_of<double>(none)) << none;
    EXPECT_FALSE(number_of<int>("3000000000"));
    EXPECT_FALSE(number_of<int>("1.5"));
}

TEST(Numbers, ListsAreAsLongAsTheyAreAsked) {
    std::array<int, 2> size{};
    EXPECT_TRUE(read_numbers<int>("640x480", 'x', size));
    EXPECT_EQ(size, (std::array{640, 480}));
    for (const char* none : {"640", "640x", "640x480x2", "640,480", "x480", "640x480 "})
        EXPECT_FALSE(read_numbers<int>(none, 'x', size)) << none;
    std::array<double, 3> point{};
    EXPECT_TRUE(read_numbers<double>("1, -2,+3e0", ',', point));
    EXPECT_EQ(point, (std::array{1.0, -2.0, 3.0}));
}

TEST(Numbers, DoNotHearOfTheLocale) {
    const char* chosen = nullptr;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "ru_RU.UTF-8", "es_ES.UTF-8", "de_DE"})
        if (!chosen) chosen = std::setlocale(LC_NUMERIC, name);
    if (!chosen) GTEST_SKIP() << "no locale with a decimal comma";
    EXPECT_EQ(number_of<double>("2.5"), 2.5);
    EXPECT_FALSE(number_of<double>("2,5"));
    std::setlocale(LC_NUMERIC, "C");
}

}  // namespace
}  // namespace kinora
