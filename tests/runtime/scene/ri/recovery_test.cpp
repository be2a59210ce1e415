// tests/runtime/scene/ri/recovery_test.cpp: streams that are wrong, and where reading goes on.
#include <gtest/gtest.h>

#include "tests/runtime/scene/ri/recorded_calls.h"

namespace kinora::ri {
namespace {

struct WrongRow {
    const char* stream;
    Texts calls, findings;
};

void expect_rows(const std::vector<WrongRow>& rows) {
    for (const WrongRow& row : rows) {
        ReadCalls read = read_calls(row.stream);
        EXPECT_EQ(read.calls, row.calls) << row.stream;
        EXPECT_EQ(read.findings, row.findings) << row.stream;
    }
}

TEST(RibRecovery, SyntaxErrorsGoOnAtTheNextKnownRequest) {
    expect_rows({
        {"Sides 1\n  [1 2] Foo Matte 1",
         {"Sides 1i", "Matte 1i"},
         {"RIB_ARGUMENT 2:3", "RIB_REQUEST_UNKNOWN 2:9"}},
        {"\"a\" Sides 1", {"Sides 1i"}, {"RIB_SYNTAX 1:1"}},
        {"Sides 1 ; Matte 1", {"Sides 1i", "Matte 1i"}, {"RIB_SYNTAX 1:9"}},
        {"Color [1 0\nMatte 1", {"Matte 1i"}, {"RIB_SYNTAX 2:1"}},
        {"Color [1 [0] 1]\nMatte 1", {"Matte 1i"}, {"RIB_SYNTAX 1:10"}},
        {"Points \"P\" [0 0 0", {}, {"RIB_SYNTAX 1:18"}},
        {"Points \"P\" [0 0 0 Bar Matte 1", {"Matte 1i"}, {"RIB_SYNTAX 1:19"}},
        {"Points \"P\" ] Matte 1", {"Matte 1i"}, {"RIB_SYNTAX 1:12"}},
        {"Orientation \"lh\nMatte 1", {"Matte 1i"}, {"RIB_SYNTAX 1:13"}},
        {"Surface \"a\" \"nope\" [1 Matte 1",
         {"Matte 1i"},
         {"RIB_TOKEN_UNKNOWN 1:13", "RIB_SYNTAX 1:23"}},
    });
}

TEST(RibRecovery, UnclosedStringsEndWithTheirLine) {
    expect_rows({{"Orientation \"lh\nSides 1\n\\\"\n\\\"\nMatte 1",
                  {"Sides 1i", "Matte 1i"},
                  {"RIB_SYNTAX 1:13", "RIB_SYNTAX 3:1"}}});
}

TEST(RibRecovery, UnknownRequestsAreSkippedAndCounted) {
    ReadCalls read = read_calls(
        "Bxdf \"a\" \"b\" \"float x\" [1]\nSides 1\nBxdf \"a\"\nPattern 1 [2] 3 Matte 1");
    EXPECT_EQ(read.calls, (Texts{"Sides 1i", "Matte 1i"}));
    EXPECT_EQ(read.findings, (Texts{"RIB_REQUEST_UNKNOWN 1:1", "RIB_REQUEST_UNKNOWN 4:1"}));
    EXPECT_NE(read.messages[0].find("2 times"), std::string::npos);
}

TEST(RibRecovery, ArgumentsOfTheWrongFormLeaveTheRequestOut) {
    expect_rows({
        {"Sphere 1 -1 1\nSides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:1"}},
        {"Sphere 1 -1 1", {}, {"RIB_ARGUMENT 1:1"}},
        {"Sphere \"a\" Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:8"}},
        {"Orientation 3 Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:13"}},
        {"Orientation Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:1"}},
        {"Basis \"round\" 3 \"bezier\" 3 Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:7"}},
        {"MotionBegin [\"a\"] Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:13"}},
        {"LightSource \"a\" Sides 1", {"Sides 1i"}, {"RIB_ARGUMENT 1:1"}},
        {"Procedural \"Foo\" [\"a\"] [0 1 0 1 0 1]", {}, {"RI_COUNTS 1:1"}},
        {"ErrorHandler \"cry\"", {}, {"RIB_ARGUMENT 1:1"}},
    });
}

TEST(RibRecovery, ArgumentsBeyondTheLastAreLeftOut) {
    expect_rows({
        {"WorldBegin 3 Sides 1", {"WorldBegin", "Sides 1i"}, {"RIB_ARGUMENT 1:12"}},
        {"Sphere [1 -1 1 360 5]", {"Sphere 1 -1 1 360"}, {"RIB_ARGUMENT 1:1"}},
        {"Sphere 1 -1 1 360 5 6 \"Cs\" [1 1 1 1 1 1 1 1 1 1 1 1]",
         {"Sphere 1 -1 1 360 \"varying color Cs\" [1 1 1 1 1 1 1 1 1 1 1 1]"},
         {"RIB_ARGUMENT 1:19"}},
        {"Surface \"a\" \"Kd\" \"b\" \"Ks\" 1 Sides 1",
         {"Surface \"a\" \"uniform float Ks\" [1]", "Sides 1i"},
         {"RIB_ARGUMENT 1:18"}},
    });
}

TEST(RibRecovery, LengthsAreJudgedByDeclarations) {
    expect_rows({
        {"Sphere 1 -1 1 360 \"Cs\" [1 0 0]", {"Sphere 1 -1 1 360"}, {"RIB_PARAMETER_LENGTH 1:19"}},
        {"Surface \"a\" \"Kd\" [1 2]",
         {"Surface \"a\" \"uniform float Kd\" [1]"},
         {"RIB_PARAMETER_LENGTH 1:13"}},
        {"PointsPolygons [3] [0 1 2] \"P\" [0 0 0] Sides 1",
         {"Sides 1i"},
         {"RIB_PARAMETER_LENGTH 1:28"}},
        {"PointsPolygons [3] [0 1 2000000000] \"P\" [0 0 0] Sides 1",
         {"Sides 1i"},
         {"RIB_PARAMETER_LENGTH 1:37"}},
        {"PointsPolygons [3] [0 1 -2] \"P\" [0 0 0] Sides 1", {"Sides 1i"}, {"RI_COUNTS 1:1"}},
        {"PointsPolygons [4] [0 1 2] \"P\" [0 0 0 1 1 1 2 2 2] Sides 1",
         {"Sides 1i"},
         {"RI_COUNTS 1:1"}},
        {"Polygon \"Cs\" [0 0 0] Sides 1", {"Sides 1i"}, {"RI_DATA_MISSING 1:1"}},
        {"Polygon \"P\" [0 0 0 1 1 1 2 2 2 3]",
         {"Polygon \"vertex point P\" [0 0 0 1 1 1 2 2 2]"},
         {"RIB_PARAMETER_LENGTH 1:9"}},
        {"NuPatch 2 2 [0 0 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]",
         {},
         {"RI_COUNTS 1:1"}},
        {"TrimCurve [1] [2] [0 0 1] [0] [1] [2] [0 1] [0 1] [1 1]", {}, {"RI_COUNTS 1:1"}},
        {"TrimCurve [1] [2] [0 0 1 1] [0] [1] [-2] [0 1] [0 1] [1 1]", {}, {"RI_COUNTS 1:1"}},
        {"ColorSamples [1 1] [1 1]", {}, {"RI_COUNTS 1:1"}},
        {"SubdivisionMesh \"catmull-clark\" [3] [0 1 2] [\"crease\"] [2 1] [0] [5] "
         "\"P\" [0 0 0 1 0 0 0 1 0]",
         {},
         {"RI_COUNTS 1:1"}},
    });
}

TEST(RibRecovery, WhatIsNoRibSaysSo) {
    EXPECT_FALSE(read_calls("surface plastic ( ) { }").is_rib);
    EXPECT_FALSE(read_calls(std::string("\0\5\26\7Mac OS X", 12)).is_rib);
    EXPECT_TRUE(read_calls("").is_rib);
    EXPECT_TRUE(read_calls("# nothing\n").is_rib);
}

TEST(RibRecovery, FindingsAreLimited) {
    std::string stream;
    for (int i = 0; i < 1000; ++i) stream += "Sides\n";
    ReadCalls read = read_calls(stream);
    EXPECT_EQ(read.findings.size(), 201u);
    EXPECT_EQ(read.findings.back(), "RIB_MORE 1:1");
    EXPECT_EQ(read.messages.back(), "800 more findings in this file");
}

}  // namespace
}  // namespace kinora::ri
