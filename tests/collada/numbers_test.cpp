// tests/collada/numbers_test.cpp: numbers as exporters write them.
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <random>

#include "collada/numbers_p.h"
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
        "t.dae", "<COLLADA><p>1 -2 99999999999999999999 +4 5.5 x</p></COLLADA>", r.diag);
    r.diag.clear();
    auto values = read_ints(*r.document, *r.document->root().child("p"), r.diag);
    EXPECT_EQ(values, (std::vector<int32_t>{1, -2, 2147483647, 4, 0, 0}));
    EXPECT_EQ(r.pointed("SRC_NUMBER"), "5.5");
}

}  // namespace
}  // namespace kinora::collada
