// tests/base/diagnostic_test.cpp: findings, their places and how they print.
#include "runtime/base/diagnostic.h"

#include <gtest/gtest.h>

#include <thread>

#include "runtime/base/raise_findings.h"

namespace kinora {
namespace {

constexpr FindingInfo kOdd =
    finding_row("TEST_ODD", Severity::Warning, "'{}' is {} times odd", "why", "fix it");

TEST(SourceFiles, LinesAndColumnsCountFromOneInBytes) {
    SourceFiles files;
    FileId id = files.add("a.sl", "one\ntwo\r\n\nfour");
    struct {
        uint32_t offset;
        int line, column;
    } rows[] = {{0, 1, 1}, {2, 1, 3}, {3, 1, 4}, {4, 2, 1}, {9, 3, 1}, {10, 4, 1}, {14, 4, 5}};
    for (const auto& row : rows) {
        EXPECT_EQ(files.line_column(id, row.offset).line, row.line) << row.offset;
        EXPECT_EQ(files.line_column(id, row.offset).column, row.column) << row.offset;
    }
    EXPECT_EQ(files.line_text(id, 2), "two");
    EXPECT_EQ(files.line_text(id, 3), "");
    EXPECT_EQ(files.line_text(id, 4), "four");
    EXPECT_EQ(files.line_text(id, 5), "");
    EXPECT_EQ(files.line_text(id, 0), "");
}

TEST(SourceFiles, AForkSharesWhatThereWasAndKeepsTheRestToItself) {
    SourceFiles files;
    FileId first = files.add("a.sl", "one\ntwo");
    SourceFiles fork = files.fork(), copy = files;
    FileId mine = fork.add("mine.sl", "x\ny"), theirs = copy.add("theirs.sl", "z");
    EXPECT_EQ(mine, theirs);
    EXPECT_EQ(fork.name(mine), "mine.sl");
    EXPECT_EQ(files.name(theirs), "theirs.sl");
    EXPECT_EQ(fork.text(first).data(), files.text(first).data());
    EXPECT_EQ(fork.line_column(first, 4).line, 2);
    EXPECT_EQ(files.line_column(first, 4).line, 2);
    EXPECT_EQ(fork.line_text(mine, 2), "y");
}

TEST(SourceFiles, CutLinesKeepTheirPlaces) {
    SourceFiles files;
    const std::string numbers(100'000, '7');
    const std::string text = "<a>\n" + numbers + "\r\n<b>\n\n" + numbers;
    FileId id = files.add("a.dae", text), small = files.add("b.sl", "one\r\ntwo");
    const char* unchanged = files.text(small).data();
    std::vector<LineColumn> before;
    for (uint32_t offset = 0; offset <= text.size(); ++offset)
        before.push_back(files.line_column(id, offset));
    for (int times = 0; times < 2; ++times) {
        files.cut_long_lines();
        EXPECT_LT(files.text(id).size(), 2 * SourceFiles::kLongestKept + 20);
        EXPECT_EQ(files.text(small).data(), unchanged);
        for (uint32_t offset = 0; offset <= text.size(); ++offset) {
            ASSERT_EQ(files.line_column(id, offset).line, before[offset].line) << offset;
            ASSERT_EQ(files.line_column(id, offset).column, before[offset].column) << offset;
        }
        EXPECT_EQ(files.line_text(id, 1), "<a>");
        EXPECT_EQ(files.line_text(id, 2), numbers.substr(0, SourceFiles::kLongestKept));
        EXPECT_EQ(files.line_text(id, 3), "<b>");
        EXPECT_EQ(files.line_text(id, 4), "");
        EXPECT_EQ(files.line_text(id, 5), numbers.substr(0, SourceFiles::kLongestKept));
        EXPECT_EQ(files.line_text(small, 1), "one");
    }
    Diagnostics diagnostics;
    diagnostics.files = files;
    diagnostics.report(kOdd, {id, 10, 12}, "x", 3);
    diagnostics.report(kOdd, {id, 50'000, 50'002}, "x", 3);
    const std::string near = format_finding(diagnostics.findings()[0], files),
                      far = format_finding(diagnostics.findings()[1], files);
    EXPECT_TRUE(near.starts_with("a.dae:2:7: ")) << near;
    EXPECT_NE(near.find("^~"), std::string::npos) << near;
    EXPECT_TRUE(far.starts_with("a.dae:2:49997: ")) << far;
    EXPECT_EQ(far.find('^'), std::string::npos) << far;  // what stood there is gone
}

TEST(SourceMap, MapsThroughItsSegments) {
    // "a&lt;b]]>...<![CDATA[c" decoded to "a<bc": the file's offsets jump twice.
    SourceMap map{3, {{0, 100}, {2, 105}, {3, 120}}};
    EXPECT_EQ(map.file_offset(0), 100u);
    EXPECT_EQ(map.file_offset(1), 101u);
    EXPECT_EQ(map.file_offset(2), 105u);
    EXPECT_EQ(map.file_offset(7), 124u);
    Location range = map.location(1, 3);
    EXPECT_EQ(range.file, 3u);
    EXPECT_EQ(range.begin, 101u);
    EXPECT_EQ(range.end, 106u);  // not 120: the end maps through the last character
    EXPECT_EQ(SourceMap{}.file_offset(9), 9u);
}

TEST(Diagnostics, PrintPlaceCodeCaretNotesAndHelp) {
    Diagnostics diagnostics;
    FileId id = diagnostics.files.add("dir/a.sl", "float x;\n\tfloat yy = 1;\n");
    Finding& finding = diagnostics.report(kOdd, {id, 16, 18}, "yy", 3);
    finding.id_path = "effect[@id='E']";
    finding.notes.push_back({{id, 6, 7}, "first defined here"});
    EXPECT_EQ(format_finding(finding, diagnostics.files),
              "dir/a.sl:2:8: warning: 'yy' is 3 times odd [TEST_ODD]\n"
              "    in effect[@id='E']\n"
              "    \tfloat yy = 1;\n"
              "    \t      ^~\n"
              "dir/a.sl:1:7: note: first defined here\n"
              "    float x;\n"
              "          ^\n"
              "    help: fix it\n");
}

TEST(Diagnostics, AFindingWithoutAFilePrintsTheProgramsName) {
    Diagnostics diagnostics;
    Finding& finding = diagnostics.report(kOdd, {}, "all", 1);
    finding.help = "";
    EXPECT_EQ(format_finding(finding, diagnostics.files),
              "kinora: warning: 'all' is 1 times odd [TEST_ODD]\n");
}

TEST(Diagnostics, PlacesAtAndBeyondTheEndOfALinePrintSafely) {
    Diagnostics diagnostics;
    std::string wide(5000, 'x');
    FileId id = diagnostics.files.add("w", "ab\n" + wide);
    for (Location where : {Location{id, 2, 2}, Location{id, 2, 900}, Location{id, 4000, 4100},
                           Location{id, 5003, 5003}, Location{id, 9999, 10000}}) {
        std::string text =
            format_finding(diagnostics.report(kOdd, where, "w", 1), diagnostics.files);
        EXPECT_NE(text.find('^'), std::string::npos);
        EXPECT_LT(text.size(), 800u);  // long lines are shown around the place only
    }
}

TEST(Diagnostics, SeveritiesCanBeOverriddenByCode) {
    Diagnostics diagnostics;
    diagnostics.report(kOdd, {}, "a", 1);
    EXPECT_FALSE(diagnostics.has_errors());
    diagnostics.set_severity("TEST_ODD", Severity::Error);
    diagnostics.report(kOdd, {}, "b", 2);
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_EQ(diagnostics.count(Severity::Error), 1);
    EXPECT_EQ(diagnostics.count(Severity::Warning), 1);
}

TEST(Diagnostics, DropRepeatsKeepsWhatIsNewAndErrors) {
    Diagnostics diagnostics;
    Location there{0, 5, 6};
    diagnostics.report(kOdd, {}, "a", 1);
    diagnostics.report(kOdd, there, "a", 1);
    size_t first = diagnostics.findings().size();
    diagnostics.report(kOdd, {}, "a", 1);
    diagnostics.report(kOdd, {}, "a", 2);
    diagnostics.report(kOdd, there, "a", 1);
    diagnostics.report(kOdd, {}, "a", 2);
    diagnostics.drop_repeats(first);
    ASSERT_EQ(diagnostics.findings().size(), 3u);
    EXPECT_NE(diagnostics.findings()[2].message, diagnostics.findings()[0].message);
    diagnostics.set_severity("TEST_ODD", Severity::Error);
    diagnostics.report(kOdd, {}, "a", 1);
    diagnostics.report(kOdd, {}, "a", 1);
    diagnostics.drop_repeats(3);
    EXPECT_EQ(diagnostics.findings().size(), 5u);
}

TEST(SourceFiles, CopiesShareTheTexts) {
    SourceFiles files;
    FileId a = files.add("a", "one\ntwo");
    SourceFiles copy = files;
    FileId b = copy.add("b", "three");
    EXPECT_EQ(files.text(b), "three");
    EXPECT_EQ(copy.name(a), "a");
    EXPECT_EQ(copy.line_column(a, 5).line, 2);
    EXPECT_EQ(files.count(), 2u);
}

TEST(Diagnostics, TakeReportsFromManyThreads) {
    Diagnostics diagnostics;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 500; ++i) diagnostics.report(kOdd, {}, "x", i);
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(diagnostics.count(Severity::Warning), 2000);
}

TEST(Diagnostics, WhatWasLeftOutBecomesTheErrorWhereNothingIsLeft) {
    constexpr FindingInfo kCut =
        finding_row("FORM_CUT", Severity::Warning, Severity::Error, "cut", "", "");
    constexpr FindingInfo kRead =
        finding_row("FORM_READ", Severity::Info, Severity::Warning, "read", "", "");
    Diagnostics d;
    d.judge(Judgement::Rendering);
    d.report(kOdd, Location{}, "a", 1);
    EXPECT_FALSE(raise_findings(d, "FORM_"));
    d.report(kCut, Location{}).notes.push_back({Location{}, "opened here"});
    d.report(kRead, Location{});
    d.report(kOdd, Location{}, "b", 2);
    EXPECT_FALSE(raise_findings(d, "ELSE_"));
    EXPECT_FALSE(d.has_errors());
    EXPECT_TRUE(raise_findings(d, "FORM_"));
    ASSERT_EQ(d.findings().size(), 4u);  // in their order, with all they hold
    EXPECT_EQ(d.findings()[0].message, "'a' is 1 times odd");
    EXPECT_EQ(d.findings()[1].severity, Severity::Error);
    ASSERT_EQ(d.findings()[1].notes.size(), 1u);
    EXPECT_EQ(d.findings()[1].notes[0].message, "opened here");
    EXPECT_EQ(d.findings()[2].severity, Severity::Info);
    EXPECT_EQ(d.findings()[3].severity, Severity::Warning);
}

TEST(NearestName, FindsWhatWasMeantOrNothing) {
    std::vector<std::string_view> names{"diffuse", "specular", "Kd", "roughness"};
    EXPECT_EQ(nearest_name("difuse", names), "diffuse");
    EXPECT_EQ(nearest_name("rougness", names), "roughness");
    EXPECT_EQ(nearest_name("Ks", names), "Kd");
    EXPECT_EQ(nearest_name("elephant", names), "");
    EXPECT_EQ(nearest_name("flaot", {"color", "float"}), "float");
    EXPECT_EQ(nearest_name("x", {}), "");
}

constexpr FindingInfo kLeftOut =
    finding_row("TEST_LEFT_OUT", Severity::Warning, Severity::Error, "'{}' is left out", "", "");
constexpr FindingInfo kStyle =
    finding_row("TEST_STYLE", Severity::Info, Severity::Warning, "'{}' is odd", "", "");
constexpr FindingInfo kFatal = finding_row("TEST_FATAL", Severity::Error, "no '{}'", "", "");

TEST(Diagnostics, JudgesByWhatTheFileIsFor) {
    struct {
        Judgement judgement;
        Severity left_out, style, fatal;
    } rows[] = {
        {Judgement::Validating, Severity::Error, Severity::Warning, Severity::Error},
        {Judgement::Rendering, Severity::Warning, Severity::Info, Severity::Error},
        {Judgement::Strict, Severity::Error, Severity::Info, Severity::Error},
    };
    for (const auto& row : rows) {
        Diagnostics diag;
        diag.judge(row.judgement);
        EXPECT_EQ(diag.report(kLeftOut, {}, "a").severity, row.left_out);
        EXPECT_EQ(diag.report(kStyle, {}, "a").severity, row.style);
        EXPECT_EQ(diag.report(kFatal, {}, "a").severity, row.fatal);
        diag.set_severity("TEST_STYLE", Severity::Hint);
        EXPECT_EQ(diag.report(kStyle, {}, "b").severity, Severity::Hint);
    }
    EXPECT_EQ(Diagnostics().report(kLeftOut, {}, "a").severity, Severity::Error);
}

TEST(Diagnostics, ErrorsOfAFileThatAnotherNamesAreWarningsWhenRendering) {
    for (Judgement judgement : {Judgement::Validating, Judgement::Rendering, Judgement::Strict}) {
        Diagnostics diag;
        diag.judge(judgement);
        diag.report(kFatal, {}, "own");
        diag.report(kFatal, {}, "other");
        diag.report(kStyle, {}, "other");
        Severity style = diag.findings()[2].severity;
        diag.lower_errors(1);
        bool rendering = judgement == Judgement::Rendering;
        EXPECT_EQ(diag.findings()[0].severity, Severity::Error);
        EXPECT_EQ(diag.findings()[1].severity, rendering ? Severity::Warning : Severity::Error);
        EXPECT_EQ(diag.findings()[2].severity, style);
    }
}

}  // namespace
}  // namespace kinora
