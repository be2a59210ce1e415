// tests/collada/numbers_test.cpp: numbers as exporters write them.
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <random>

#include "collada/document/element_numbers_p.h"
#include "collada/schema/simple_types_p.h"
#include "collada/text/numbers_p.h"
#include "collada/text/words_p.h"
#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

struct Numbers {
    Reading r;
    std::vector<double> values;
    explicit Numbers(const std::string& text) {
        r.document =
            read_document_text("t.dae", "<COLLADA><extra>" + text + "</extra></COLLADA>", r.diag);
        r.diag.clear();
        values = read_doubles(*r.document, *r.document->root().child("extra"), r.diag);
    }
};

TEST(Numbers, ReadsAllForms) {
    Numbers n(" 1 -2.5 +3 .5 4. 1e3 1E-2 -0 1.7976931348623157e308 5e-324\n1e-999 00012");
    std::vector<double> expected{1,      -2.5, 3, .5, 4, 1000, .01, -0.0, 1.7976931348623157e308,
                                 5e-324, 0,    12};
    EXPECT_EQ(n.values, expected);
    EXPECT_TRUE(n.r.diag.findings().empty()) << n.r.all();
}

TEST(Numbers, AreCorrectlyRounded) {
    std::mt19937_64 random(7);
    std::string text;
    std::vector<double> expected;
    for (int i = 0; i < 20000; ++i) {
        uint64_t bits = random();
        double value;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value)) continue;
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%.*g ", 1 + int(random() % 19), value);
        text += buffer;
        expected.push_back(std::strtod(buffer, nullptr));
        if (!std::isfinite(expected.back())) expected.back() = INFINITY * (value < 0 ? -1 : 1);
        std::snprintf(buffer, sizeof buffer, "%.*f ", int(random() % 9),
                      double(random() % 100000) / 977);
        text += buffer;
        expected.push_back(std::strtod(buffer, nullptr));
    }
    EXPECT_EQ(Numbers(text).values, expected);
}

// Every way of writing a number, in lists long enough for the scan of eight digits a step, against
// std::from_chars.
TEST(Numbers, MillionsOfThemAreWhatFromCharsSays) {
    std::mt19937_64 random(29);
    const char* const edges[] = {"9007199254740993",
                                 "9007199254740992.5",
                                 "0.1000000000000000055511151231257827021181583404541015625",
                                 "9999999999999999999",
                                 "18446744073709551615",
                                 "18446744073709551616",
                                 "1.7976931348623157e308",
                                 "1.7976931348623159e308",
                                 "2.2250738585072011e-308",
                                 "4.9e-324",
                                 "2.4703282292062327208e-324",
                                 "1e22",
                                 "1e23",
                                 "8.5e-27",
                                 "123456789012345678e-27",
                                 "1234567890123456789e-27",
                                 "1234567890123456789e-28",
                                 "0.00000000000000000012345678",
                                 "00000000000000000000000000012",
                                 "-0.0",
                                 "5.",
                                 ".5",
                                 "-.25e+3",
                                 "1E0005",
                                 "4503599627370497.5",
                                 "0.500000000000000166533453693773481063544750213623046875"};
    auto word = [&](char* to, size_t room) {
        uint64_t bits = random();
        double any = std::bit_cast<double>(bits);
        double near = (double(bits >> 11) / double(uint64_t(1) << 53) - .5) *
                      std::pow(10., double(random() % 12) - 4);
        switch (random() % 8) {
            case 0:
                return std::snprintf(to, room, "%s", edges[random() % std::size(edges)]);
            case 1:
                return std::snprintf(to, room, "%.*g", 1 + int(random() % 19), any);
            case 2:
                return std::snprintf(to, room, "%.*g", 1 + int(random() % 19), near);
            case 3:
                return std::snprintf(to, room, "%.*f", int(random() % 20), near);
            case 4:
                return std::snprintf(to, room, "%.*e", int(random() % 19), near);
            case 5:
                return std::snprintf(to, room, "%d", int(random() % 2000) - 1000);
            case 6:  // digits of any number around a point
                return std::snprintf(to, room, "%llu.%llu",
                                     (unsigned long long)(bits >> random() % 64),
                                     (unsigned long long)(random() >> random() % 64));
            default:
                return std::snprintf(to, room, "%llue%d", (unsigned long long)bits,
                                     -int(random() % 32));
        }
    };
    const char* const spaces[] = {" ", "\n", "  ", "\t ", " \n  "};
    for (int list = 0; list < 30; ++list) {
        std::string text;
        std::vector<double> expected;
        for (int i = 0; i < 100000; ++i) {
            char buffer[400];
            int length = word(buffer, sizeof buffer);
            double value = 0;
            if (std::string_view(buffer).find_first_of("ni") != std::string_view::npos) continue;
            auto [stop, error] = std::from_chars(buffer, buffer + length, value);
            ASSERT_EQ(stop, buffer + length) << buffer;
            if (error != std::errc{}) continue;  // ReadsNumbersBeyondRange
            text.append(buffer, size_t(length)) += spaces[random() % 5];
            expected.push_back(value);
        }
        Numbers n(text);
        ASSERT_EQ(n.values.size(), expected.size());
        for (size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(std::bit_cast<uint64_t>(n.values[i]), std::bit_cast<uint64_t>(expected[i]))
                << expected[i];
        ASSERT_TRUE(n.r.diag.findings().empty()) << n.r.all();
    }
}

TEST(Numbers, BeyondRangeAreZeroOrInfinite) {
    std::string zeros(400, '0');
    Numbers n("0." + zeros + "1 1" + zeros + " -1e400 1e-99999999999999999999 " + "0." + zeros +
              "1e500 1" + zeros + "e-500 -1e99999999999999999999");
    std::vector<double> expected{0, INFINITY, -INFINITY, 0, 1e99, 1e-100, -INFINITY};
    EXPECT_EQ(n.values, expected);
}

TEST(Numbers, WholeOnesAreReadWhereverTheyStandInTheList) {
    std::mt19937 random(31);
    for (size_t size = 0; size < 200; ++size) {
        std::string text;
        std::vector<int32_t> expected;
        for (size_t i = 0; i < size; ++i) {
            int32_t value = int32_t(random()) >> (random() % 32);
            text += std::to_string(value) + (random() % 4 ? " " : "\n ");
            expected.push_back(value);
        }
        Reading r;
        r.document = read_document_text("t.dae", "<COLLADA><p>" + text + "</p></COLLADA>", r.diag);
        r.diag.clear();
        EXPECT_EQ(read_ints(*r.document, *r.document->root().child("p"), r.diag), expected);
        EXPECT_TRUE(r.diag.findings().empty());
    }
}

TEST(Numbers, NanAndInfinityAreKeptAndReported) {
    Numbers n("NaN -INF 1.#QNAN 1.#INF 1e999");
    ASSERT_EQ(n.values.size(), 5u);
    EXPECT_TRUE(std::isnan(n.values[0]) && std::isnan(n.values[2]));
    EXPECT_TRUE(std::isinf(n.values[1]) && std::isinf(n.values[3]) && std::isinf(n.values[4]));
    EXPECT_EQ(n.r.pointed("SRC_NAN_INF"), "NaN");
}

TEST(Numbers, WhatIsNoNumberIsNamedWithItsPlace) {
    Numbers n("1 2\n 0x1p3 1.5.2 4");
    EXPECT_EQ(n.values, (std::vector<double>{1, 2, 0, 0, 4}));
    EXPECT_EQ(n.r.pointed("SRC_NUMBER"), "0x1p3");
    EXPECT_EQ(n.r.place("SRC_NUMBER"), "2:2");
    Numbers signs("+2 +-2 -+2");
    EXPECT_EQ(signs.values, (std::vector<double>{2, 0, 0}));
    EXPECT_EQ(signs.r.pointed("SRC_NUMBER"), "+-2");
}

TEST(Numbers, DecimalCommasAreUnderstoodInAnyLocale) {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    Numbers n("1,5 2.5 -0,25");
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(n.values, (std::vector<double>{1.5, 2.5, -0.25}));
    EXPECT_EQ(n.r.count("SRC_COMMA_DECIMAL"), 1u);
}

TEST(Numbers, IntegersClampAndNameNonsense) {
    Reading r;
    r.document = read_document_text(
        "t.dae",
        "<COLLADA><p>1 -2 99999999999999999999 +4 5.5 x -2147483648 -2147483649</p></COLLADA>",
        r.diag);
    r.diag.clear();
    auto values = read_ints(*r.document, *r.document->root().child("p"), r.diag);
    EXPECT_EQ(values, (std::vector<int32_t>{1, -2, 2147483647, 4, 0, 0, INT32_MIN, INT32_MIN}));
    EXPECT_EQ(r.pointed("SRC_NUMBER"), "5.5");
}

// One word in a list of its kind: from_chars says what it is.
std::string random_short_word(std::mt19937& random) {
    auto digits = [&](size_t most) {
        std::string run;
        for (size_t n = random() % (most + 1); n > 0; --n) run += char('0' + random() % 10);
        return run;
    };
    std::string word = random() % 3 ? "" : "-", before = digits(9);
    bool point = random() % 4 > 0;
    std::string behind = point ? digits(11) : "";
    if (before.empty() && behind.empty()) before = "0";
    return word + before + (point ? "." : "") + behind;
}

TEST(Numbers, ShortWordsInLongListsAreTheNearestDoubles) {
    std::mt19937 random(29);
    for (int list = 0; list < 300; ++list) {
        std::string text;
        std::vector<double> expected;
        for (int n = 0; n < 100; ++n) {
            std::string word = random_short_word(random);
            double value = 0;
            std::from_chars(word.data(), word.data() + word.size(), value);
            expected.push_back(value);
            text += word + std::string(1 + random() % 3, " \n"[random() % 2]);
        }
        Numbers n(text);
        ASSERT_EQ(n.values.size(), expected.size());
        for (size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(std::bit_cast<uint64_t>(n.values[i]), std::bit_cast<uint64_t>(expected[i]))
                << i << " in " << text;
        EXPECT_TRUE(n.r.diag.findings().empty());
    }
}

TEST(Numbers, ShortWholeNumbersInLongLists) {
    std::mt19937 random(31);
    std::string text;
    std::vector<int32_t> expected;
    for (int i = 0; i < 20000; ++i) {
        int32_t value = int32_t(random() >> random() % 32);
        if (value < 0) value = -(value & 0x7fffffff);
        expected.push_back(value);
        text += std::to_string(value) + (random() % 9 ? " " : "\n\n");
    }
    Reading r;
    r.document =
        read_document_text("t.dae", "<COLLADA><extra>" + text + "</extra></COLLADA>", r.diag);
    EXPECT_EQ(read_ints(*r.document, *r.document->root().child("extra"), r.diag), expected);
}

// All texts of up to five of these, at three places of a longer text.
TEST(NumberLists, AreTheSameToBitMasksAndTable) {
    const std::string letters = "0+.e -I\n7";
    size_t accepted = 0;
    for (size_t length = 0; length <= 5; ++length) {
        size_t count = 1;
        for (size_t i = 0; i < length; ++i) count *= letters.size();
        for (size_t n = 0; n < count; ++n) {
            std::string text;
            for (size_t i = 0, rest = n; i < length; ++i, rest /= letters.size())
                text += letters[rest % letters.size()];
            for (size_t at : {0, 61, 63}) {
                std::string full = std::string(at, ' ') + text;
                ASSERT_EQ(is_real_list(full), is_real_list_by_table(full)) << full;
                for (bool signs : {false, true})
                    ASSERT_EQ(is_whole_list(full, signs), is_whole_list_by_table(full, signs))
                        << full;
                accepted += is_real_list(full);
            }
        }
    }
    EXPECT_GT(accepted, 1000u);
}

TEST(NumberLists, LongOnesAreTheSameToBitMasksAndTable) {
    const char* const words[] = {"1",
                                 "-2.5",
                                 "3e5",
                                 "+.5e-10",
                                 "7.",
                                 "12345678",
                                 "123456789012345678",
                                 "1234567890123456789",
                                 "0.000000000000000000000000000000001",
                                 "NaN",
                                 "INF",
                                 "-INF",
                                 "1.5.2",
                                 "1e5e",
                                 "--1",
                                 "1-",
                                 "1e",
                                 ".",
                                 "a"};
    std::mt19937 random(3);
    size_t accepted = 0;
    for (int i = 0; i < 30000; ++i) {
        std::string text;
        size_t good = random() % 3 ? 9 : std::size(words);
        for (size_t n = random() % 40; n > 0; --n)
            text += std::string(words[random() % good]) + (random() % 50 ? ' ' : '\n');
        if (random() % 4 == 0 && !text.empty())
            text[random() % text.size()] = "0.e- +"[random() % 6];
        ASSERT_EQ(is_real_list(text), is_real_list_by_table(text)) << text;
        for (bool signs : {false, true})
            ASSERT_EQ(is_whole_list(text, signs), is_whole_list_by_table(text, signs)) << text;
        accepted += is_real_list(text);
    }
    EXPECT_GT(accepted, 10000u);
}

}  // namespace
}  // namespace kinora::collada
