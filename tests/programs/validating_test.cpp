// tests/programs/validating_test.cpp: the parts of kinora-validate: diffs, image sizes, escapes.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/image_size.h"
#include "runtime/programs/validate/rules.h"
#include "runtime/programs/validate/unified_diff.h"

namespace kinora {

namespace {

// Applies a unified diff as its definition says: the other way round to how it is made.
std::string patched(const std::string& before, const std::string& diff) {
    std::vector<std::string> lines, out;
    std::istringstream source(before), hunks(diff);
    for (std::string line; std::getline(source, line);) lines.push_back(line);
    size_t next = 0;
    std::string line;
    std::getline(hunks, line);
    std::getline(hunks, line);
    bool newline_at_end = before.ends_with('\n');
    char last_mark = ' ';
    while (std::getline(hunks, line)) {
        if (line.starts_with("@@")) {
            int at = 0, count = 0;
            EXPECT_EQ(std::sscanf(line.c_str(), "@@ -%d,%d", &at, &count), 2);
            size_t begin = size_t(count ? at - 1 : at);
            while (next < begin) out.push_back(lines[next++]);
        } else if (line[0] == '\\') {
            if (last_mark != '-') newline_at_end = false;
            if (last_mark == '-') newline_at_end = true;
        } else {
            last_mark = line[0];
            if (line[0] != '+') {
                EXPECT_EQ(lines[next], line.substr(1));
                ++next;
            }
            if (line[0] != '-') out.push_back(line.substr(1));
        }
    }
    while (next < lines.size()) out.push_back(lines[next++]);
    std::string text;
    for (const std::string& l : out) text += l + "\n";
    if (!newline_at_end && !text.empty()) text.pop_back();
    return text;
}

std::string random_text(std::mt19937& random, int lines) {
    std::string text;
    for (int i = 0; i < lines; ++i) text += std::string(1, char('a' + random() % 5)) + "\n";
    return text;
}

std::string edited(std::string text, std::mt19937& random) {
    for (unsigned k = random() % 6; k > 0 && !text.empty(); --k) {
        size_t line = (random() % (text.size() / 2)) * 2;
        if (random() % 2)
            text.erase(line, 2 * (1 + random() % 3));
        else
            text.insert(line, random_text(random, 1 + int(random() % 3)));
    }
    return text;
}

}  // namespace

TEST(UnifiedDiff, AppliedToTheFirstTextGivesTheSecond) {
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        std::string before = random_text(random, int(random() % 40));
        std::string after = edited(before, random);
        std::string diff = unified_diff(before, after, "a", "b");
        if (before == after)
            EXPECT_EQ(diff, "");
        else
            ASSERT_EQ(patched(before, diff), after) << before << "\n---\n" << after << "\n" << diff;
    }
}

TEST(UnifiedDiff, IsShortWhereLittleChanged) {
    std::string before;
    for (int i = 0; i < 1000; ++i) before += "line " + std::to_string(i) + "\n";
    std::string after = before;
    after.replace(after.find("line 500"), 8, "LINE 500");
    EXPECT_EQ(unified_diff(before, after, "a", "b"),
              "--- a\n+++ b\n@@ -498,7 +498,7 @@\n line 497\n line 498\n line 499\n-line 500\n"
              "+LINE 500\n line 501\n line 502\n line 503\n");
}

TEST(UnifiedDiff, TellsOfAMissingLineEnd) {
    EXPECT_EQ(unified_diff("a\nb", "a\nc", "x", "x"),
              "--- x\n+++ x\n@@ -1,2 +1,2 @@\n a\n-b\n\\ No newline at end of file\n+c\n"
              "\\ No newline at end of file\n");
}

TEST(ImageSize, OfEachFormat) {
    auto size = [](std::string_view head, const char* name = "") {
        auto found = image_size_of_bytes(head, name);
        return found ? std::to_string(found->width) + "x" + std::to_string(found->height) + " " +
                           found->format
                     : "";
    };
    using namespace std::string_literals;
    EXPECT_EQ(size("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\2\0\0\0\7"s), "258x7 png");
    EXPECT_EQ(size("GIF89a\x05\x01\x03\0"s), "261x3 gif");
    EXPECT_EQ(size("\xFF\xD8\xFF\xE0\0\4xx\xFF\xC2\0\x11\x08\0\x20\1\0\3"s), "256x32 jpeg");
    EXPECT_EQ(size("BM"s + std::string(16, '\0') + "\4\0\0\0\xFE\xFF\xFF\xFF"s), "4x2 bmp");
    EXPECT_EQ(size("DDS "s + std::string(8, '\0') + "\2\0\0\0\5\0\0\0"s), "5x2 dds");
    EXPECT_EQ(size(std::string(12, '\0') + "\3\0\4\0\x18\0"s, "x.tga"), "3x4 tga");
    EXPECT_EQ(size("MM\0*\0\0\0\x08\0\2\1\0\0\3\0\0\0\1\0\x09\0\0\1\1\0\4\0\0\0\1\0\0\0\6"s),
              "9x6 tiff");
    EXPECT_EQ(size("\x76\x2f\x31\x01\2\0\0\0dataWindow\0box2i\0\x10\0\0\0"s + std::string(8, '\0') +
                   "\x0f\0\0\0\x07\0\0\0"s),
              "16x8 exr");
    EXPECT_EQ(size("nothing known"), "");
    // A head that is cut anywhere is no crash.
    std::string jpeg = "\xFF\xD8\xFF\xE0\0\4xx\xFF\xC2\0\x11\x08\0\x20\1\0\3"s;
    for (size_t n = 0; n < jpeg.size(); ++n) size(jpeg.substr(0, n));
}

TEST(JsonText, IsAlwaysValidUtf8AndEscaped) {
    EXPECT_EQ(json_string("a\"\\\n\x01\x7f"), "\"a\\\"\\\\\\n\\u0001\\u007f\"");
    EXPECT_EQ(json_string("\xC3\xA9\xC3"), "\"\xC3\xA9\xEF\xBF\xBD\"");
    EXPECT_EQ(json_string("\xED\xA0\x80"),
              "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");               // surrogate
    EXPECT_EQ(json_string("\xC0\xAF"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"");  // overlong
    EXPECT_EQ(json_number(0.1), "0.1");
    EXPECT_EQ(json_number(1.0 / 0.0), "null");
    EXPECT_EQ(xml_text("<&\">\x02"), "&lt;&amp;&quot;&gt;\xEF\xBF\xBD");
    EXPECT_EQ(uri_of_path("a b/\xC3\xA9#.dae"), "a%20b/%C3%A9%23.dae");
    EXPECT_EQ(uri_of_path("/x"), "file:///x");
}

TEST(Rules, AreSortedOnceEachAndFound) {
    const auto& rules = validate_rules();
    for (size_t i = 0; i < rules.size(); ++i) {
        if (i) {
            EXPECT_LT(std::string_view(rules[i - 1]->code), rules[i]->code);
        }
        EXPECT_EQ(rule_index(*rules[i]), i);
        EXPECT_EQ(find_rule(rules[i]->code), rules[i]);
        EXPECT_EQ(rule_text(*rules[i]).find('{'), std::string::npos) << rules[i]->text;
    }
    EXPECT_EQ(find_rule("NO_SUCH"), nullptr);
    EXPECT_NE(find_rule("FRAME_UNWRITABLE"), nullptr);  // another program's
}

}  // namespace kinora
