// tests/rsl/spline_test.cpp: curves that are solved for their place, and constant ones.
#include <gtest/gtest.h>

#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

TEST(Spline, SolvedGivesThePlaceOfItsValue) {
    for (const char* basis : {"catmull-rom", "bspline", "linear", "bezier", ""})
        for (const char* knots : {"0, 0.2, 0.7, 1", "1, 0.7, 0.2, 0"})
            for (float x : {0.0f, 0.1f, 0.5f, 0.9f, 1.0f}) {
                std::string name = "\"" + std::string(basis) + "\"";
                if (!basis[0]) name = "\"catmull-rom\"";
                std::string at = std::to_string(x), tail = std::string(knots);
                std::string there = "spline(" + name + ", " + at + ", " + tail + ")";
                std::string solve =
                    "spline(\"solve" + std::string(basis) + "\", " + there + ", " + tail + ")";
                EXPECT_NEAR(evaluate(solve), x, 2e-6f) << solve;
            }
}

TEST(Spline, SolvedBeyondItsEndsGivesThem) {
    EXPECT_EQ(evaluate("spline(\"solvelinear\", -5, 0, 1, 2, 3)"), 0);
    EXPECT_EQ(evaluate("spline(\"solvelinear\", 50, 0, 1, 2, 3)"), 1);
    EXPECT_NEAR(evaluate("spline(\"solvelinear\", s, 0, 1, 2, 3)", "s = 1.5;"), 0.5f, 1e-6f);
}

TEST(Spline, ConstantStaysAtItsKnot) {
    EXPECT_EQ(evaluate("spline(\"constant\", 0.1, 9, 1, 2, 3, 9)"), 1);
    EXPECT_EQ(evaluate("spline(\"constant\", 0.6, 9, 1, 2, 3, 9)"), 2);
}

}  // namespace
}  // namespace kinora::rsl
