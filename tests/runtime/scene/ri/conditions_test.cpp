// tests/runtime/scene/ri/conditions_test.cpp: IfBegin, ElseIf, Else and IfEnd.
#include "runtime/scene/ri/state/conditions.h"
#include "rib_scene.h"

namespace kinora::ri {
namespace {

std::optional<ConditionValue> known_value(std::string_view name) {
    if (name == "three") return ConditionValue{std::nullopt, 3};
    if (name == "user:pass") return ConditionValue{"beauty", 0};
    if (name == "zero") return ConditionValue{};
    return std::nullopt;
}

Condition condition(std::string_view text) {
    return evaluate_condition(text, known_value);
}

TEST(RiConditions, AreComputed) {
    struct Row {
        const char* text;
        bool value;
    };
    for (const Row& row : std::initializer_list<Row>{
             {"1", true},
             {"0", false},
             {"'text'", true},
             {"''", false},
             {"$three", true},
             {"$zero", false},
             {"!$zero", true},
             {"!!$three", true},
             {"$three == 3", true},
             {"${three}==3.0", true},
             {"$three != 3", false},
             {"$three < 3", false},
             {"$three <= 3", true},
             {"$three > 2.5e0", true},
             {"$three >= 3e-1", true},
             {"-$three < 0", true},
             {"1 + 2 * 3 == 7", true},
             {"(1 + 2) * 3 == 9", true},
             {"7 - 2 - 1 == 4", true},
             {"8 / 4 / 2 == 1", true},
             {"7 % 4 == $three", true},
             {"$user:pass == 'beauty'", true},
             {"$user:pass == beauty", true},
             {"$user:pass != 'beauty'", false},
             {"$user:pass == 3", false},
             {"$user:pass < 'gamma'", true},
             {"defined(three)", true},
             {"defined($three)", true},
             {"defined( user:pass )", true},
             {"defined(nothing)", false},
             {"!defined(nothing) && $three == 3", true},
             {"0 || 1 && 0", false},
             {"(0 || 1) && 1", true},
             {"1 == 1 == 1", true},
             {" ( ( $three ) ) ", true},
         }) {
        Condition made = condition(row.text);
        EXPECT_EQ(made.value, std::optional(row.value)) << row.text << ": " << made.why;
        EXPECT_EQ(made.unknown, "") << row.text;
    }
}

TEST(RiConditions, WhatCannotBeReadHasNoValue) {
    const std::string deep(5000, '('), signs(100000, '!');
    for (const std::string& text :
         {std::string(), std::string("("), std::string("1 1"), std::string("1 =="),
          std::string("'open"), std::string("$"), std::string("${three"), std::string("defined"),
          std::string("defined()"), std::string("defined(three"), std::string("1.2.3"),
          std::string("1 = 1"), std::string("&& 1"), std::string("@"), deep, signs}) {
        Condition made = condition(text);
        EXPECT_FALSE(made.value) << text.substr(0, 40);
        EXPECT_NE(made.why, "") << text.substr(0, 40);
    }
}

TEST(RiConditions, NamesThatNobodySetAreZero) {
    Condition made = condition("$nothing == 0 && $other == 0");
    EXPECT_EQ(made.value, std::optional(true));
    EXPECT_EQ(made.unknown, "nothing");
}

const std::string kRed = "Color 1 0 0 ", kGreen = "Color 0 1 0 ", kBlue = "Color 0 0 1 ",
                  kPlainBall = "Sphere 1 -1 1 360 ";

// The colour of a sphere behind all that.
dvec3 color_after(const std::string& inside, const std::string& before = "") {
    RibWorlds r(before + "WorldBegin " + inside + kPlainBall + "WorldEnd");
    EXPECT_EQ(r.findings(), "") << inside;
    return color_of(r.world(), r.primitive());
}

TEST(RiConditions, OneBranchIsRead) {
    auto branches = [](const std::string& a, const std::string& b) {
        return "IfBegin \"" + a + "\" " + kRed + "ElseIf \"" + b + "\" " + kGreen + "Else " +
               kBlue + "IfEnd ";
    };
    EXPECT_EQ(color_after(branches("1", "1")), dvec3(1, 0, 0));
    EXPECT_EQ(color_after(branches("0", "1")), dvec3(0, 1, 0));
    EXPECT_EQ(color_after(branches("0", "0")), dvec3(0, 0, 1));
    EXPECT_EQ(color_after("IfBegin \"0\" " + kRed + "IfEnd "), dvec3(1, 1, 1));
    EXPECT_EQ(color_after("IfBegin \"0\" " + branches("1", "1") + "Else " + branches("0", "1") +
                          "IfEnd "),
              dvec3(0, 1, 0));
    EXPECT_EQ(color_after("IfBegin \"1\" " + branches("0", "0") + "Else " + branches("0", "1") +
                          "IfEnd "),
              dvec3(0, 0, 1));
}

TEST(RiConditions, OptionsAndAttributesAreVariables) {
    const std::string pass = "Option \"user\" \"string pass\" [\"beauty\"] \"float level\" [2] ";
    auto when = [](const std::string& text) {
        return "IfBegin \"" + text + "\" " + kRed + "IfEnd ";
    };
    const dvec3 yes(1, 0, 0), no(1, 1, 1);
    EXPECT_EQ(color_after(when("$pass == 'beauty'"), pass), yes);
    EXPECT_EQ(color_after(when("$user:pass == 'shadow'"), pass), no);
    EXPECT_EQ(color_after(when("$Option:user:level > 1"), pass), yes);
    EXPECT_EQ(color_after(when("defined(Option:user:level)")), no);
    EXPECT_EQ(color_after("Attribute \"user\" \"int far\" [3] " + when("$Attribute:user:far == 3")),
              yes);
    EXPECT_EQ(color_after("AttributeBegin Attribute \"user\" \"int far\" [3] AttributeEnd " +
                          when("defined(Attribute:user:far)")),
              no);
    EXPECT_EQ(color_after("Attribute \"identifier\" \"name\" [\"tree\"] " +
                          when("$Attribute:identifier:name == 'tree'")),
              yes);
    EXPECT_EQ(color_after("IfBegin \"$x == 4\" \"float x\" [4] " + kRed + "IfEnd "), yes);
    RibWorlds frame("FrameBegin 12 WorldBegin " + when("$Frame == 12") + kPlainBall +
                    "WorldEnd FrameEnd");
    EXPECT_EQ(color_of(frame.world(), frame.primitive()), yes);
}

TEST(RiConditions, StandInArchivesAndObjects) {
    const std::string choice = "IfBegin \"$near\" " + kRed + "Else " + kGreen + "IfEnd ";
    const std::string kept = "ArchiveBegin \"a\" " + choice + "ArchiveEnd ";
    EXPECT_EQ(color_after("Attribute \"user\" \"int near\" 1 ReadArchive \"a\" ", kept),
              dvec3(1, 0, 0));
    EXPECT_EQ(color_after("Attribute \"user\" \"int near\" 0 ReadArchive \"a\" ", kept),
              dvec3(0, 1, 0));
}

TEST(RiConditions, WhatIsWrongIsTold) {
    EXPECT_EQ(RibWorlds("IfBegin \"1 +\" IfEnd WorldBegin WorldEnd").count("RI_CONDITION"), 1);
    EXPECT_EQ(RibWorlds("IfBegin \"$no\" IfEnd IfBegin \"$no\" IfEnd WorldBegin WorldEnd")
                  .count("RI_CONDITION"),
              1);
    EXPECT_EQ(RibWorlds("Else IfEnd ElseIf \"1\" WorldBegin WorldEnd").count("RI_NESTING"), 3);
    RibWorlds open("WorldBegin " + kPlainBall + "WorldEnd IfBegin \"0\" WorldBegin WorldEnd");
    EXPECT_EQ(open.count("RI_NESTING"), 1);
    EXPECT_EQ(open.worlds.size(), 1u);
}

// What is left out does not change how many values a patch has.
TEST(RiConditions, ABasisThatIsLeftOutCountsNothing) {
    RibWorlds r(
        "WorldBegin IfBegin \"0\" Basis \"b-spline\" 1 \"b-spline\" 1 IfEnd "
        "PatchMesh \"bicubic\" 7 \"nonperiodic\" 4 \"nonperiodic\" \"P\" [" +
        [] {
            std::string points;
            for (int v = 0; v < 4; ++v)
                for (int u = 0; u < 7; ++u) points += fmt::format("{} {} 3 ", u, v);
            return points;
        }() +
        "] \"varying float heat\" [1 2 3 4 5 6] WorldEnd");
    EXPECT_EQ(r.findings(), "");
    EXPECT_EQ(r.primitives().size(), 1u);
}

}  // namespace
}  // namespace kinora::ri
