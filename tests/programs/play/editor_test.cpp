// tests/programs/play/editor_test.cpp: the editor's buffer, its undo, colours, completion, manual.
#include <gtest/gtest.h>

#include <random>

#include "runtime/programs/play/editor/language.h"
#include "runtime/programs/play/editor/text_buffer.h"

namespace kinora::play {
namespace {

TextBuffer typed(std::string_view text) {
    TextBuffer buffer;
    for (char c : text) buffer.type(std::string(1, c));
    return buffer;
}

TEST(TextBuffer, UndoTakesBackWordByWord) {
    TextBuffer buffer = typed("Ci = Cs;");
    for (const char* expected : {"Ci = ", "Ci ", ""}) {
        EXPECT_TRUE(buffer.undo());
        EXPECT_EQ(buffer.text(), expected);
    }
    EXPECT_FALSE(buffer.undo());
    while (buffer.redo()) {
    }
    EXPECT_EQ(buffer.text(), "Ci = Cs;");
}

TEST(TextBuffer, ErasedCharactersComeBackInOrder) {
    TextBuffer buffer("abcdef");
    buffer.set_caret(4);
    buffer.erase_back();
    buffer.erase_back();
    EXPECT_EQ(buffer.text(), "abef");
    buffer.undo();
    EXPECT_EQ(buffer.text(), "abcdef");
    EXPECT_EQ(buffer.caret(), 4u);
    buffer.set_caret(1);
    buffer.erase_forward();
    buffer.erase_forward();
    EXPECT_EQ(buffer.text(), "adef");
    buffer.undo();
    EXPECT_EQ(buffer.text(), "abcdef");
}

TEST(TextBuffer, CharactersOfSeveralBytesAreWhole) {
    TextBuffer buffer(
        "a\xc3\xa9\xe2\x82\xac"
        "b");
    buffer.move(Motion::TextEnd);
    buffer.move(Motion::Left);
    buffer.erase_back();
    EXPECT_EQ(buffer.text(),
              "a\xc3\xa9"
              "b");
    buffer.set_caret(2);  // within a character
    EXPECT_EQ(buffer.caret(), 1u);
    buffer.move(Motion::Right, true);
    EXPECT_EQ(buffer.selected(), "\xc3\xa9");
    EXPECT_EQ(buffer.column_of(buffer.text().size()), 3u);
}

TEST(TextBuffer, MotionsKeepTheColumnAcrossShortLines) {
    TextBuffer buffer("abcdef\nx\nabcdef");
    buffer.set_caret(5);
    buffer.move(Motion::Down);
    EXPECT_EQ(buffer.caret(), 8u);
    buffer.move(Motion::Down);
    EXPECT_EQ(buffer.caret(), 14u);
    buffer.move(Motion::Up, false, 9);
    EXPECT_EQ(buffer.caret(), 0u);
}

TEST(TextBuffer, HomeGoesToTheIndentFirst) {
    TextBuffer buffer("    Ci = 1;");
    buffer.move(Motion::TextEnd);
    buffer.move(Motion::LineStart);
    EXPECT_EQ(buffer.caret(), 4u);
    buffer.move(Motion::LineStart);
    EXPECT_EQ(buffer.caret(), 0u);
}

TEST(TextBuffer, NewLinesIndentAsTheLineAbove) {
    TextBuffer buffer("    if (x) {");
    buffer.move(Motion::TextEnd);
    buffer.new_line();
    EXPECT_EQ(buffer.text(), "    if (x) {\n        ");
    buffer.type("y;");
    buffer.new_line();
    EXPECT_EQ(buffer.text(), "    if (x) {\n        y;\n        ");
}

TEST(TextBuffer, LinesSelectedAreIndentedTogether) {
    TextBuffer buffer("a\nb\n\nc");
    buffer.set_caret(0);
    buffer.set_caret(4, true);
    buffer.indent(false);
    EXPECT_EQ(buffer.text(), "    a\n    b\n\nc");
    buffer.indent(true);
    EXPECT_EQ(buffer.text(), "a\nb\n\nc");
    EXPECT_TRUE(buffer.undo());
    EXPECT_TRUE(buffer.undo());
    EXPECT_EQ(buffer.text(), "a\nb\n\nc");
}

TEST(TextBuffer, AChangeFromElsewhereKeepsCaretAndUndo) {
    TextBuffer buffer("float x = 1;\nCi = x;");
    buffer.set_caret(15);
    buffer.replace_all("float x = 0.25;\nCi = x;");
    EXPECT_EQ(buffer.caret(), 18u);
    EXPECT_TRUE(buffer.undo());
    EXPECT_EQ(buffer.text(), "float x = 1;\nCi = x;");
    buffer.replace_all(buffer.text());
    EXPECT_TRUE(buffer.redo()) << "what changes nothing is no edit";
}

// Any edits, then undo to the beginning and redo to the end.
TEST(TextBuffer, AllEditsUndoAndRedo) {
    std::mt19937 engine(5);
    for (int trial = 0; trial < 50; ++trial) {
        TextBuffer buffer("surface a() {\n\tCi = \xe2\x82\xac;\n}\n");
        const std::string first = buffer.text();
        for (int i = 0; i < 200; ++i) {
            switch (engine() % 9) {
                case 0:
                    buffer.erase_back(engine() % 2);
                    break;
                case 1:
                    buffer.erase_forward(engine() % 2);
                    break;
                case 2:
                    buffer.new_line();
                    break;
                case 3:
                    buffer.indent(engine() % 2);
                    break;
                case 4:
                    buffer.set_caret(engine() % (buffer.text().size() + 1), engine() % 2);
                    break;
                case 5:
                    buffer.move(static_cast<Motion>(engine() % 10), engine() % 2);
                    break;
                case 6:
                    buffer.replace_all("x" + buffer.text().substr(0, buffer.text().size() / 2));
                    break;
                default:
                    buffer.type(engine() % 3 ? "q" : " ");
                    break;
            }
            ASSERT_LE(buffer.caret(), buffer.text().size());
        }
        const std::string last = buffer.text();
        while (buffer.undo()) {
        }
        ASSERT_EQ(buffer.text(), first) << trial;
        while (buffer.redo()) {
        }
        ASSERT_EQ(buffer.text(), last) << trial;
    }
}

std::vector<std::pair<std::string, Ink>> inks(std::string_view text) {
    std::vector<std::pair<std::string, Ink>> out;
    for (const InkRun& run : color_runs(text))
        if (run.ink != Ink::Plain)
            out.emplace_back(text.substr(run.begin, run.end - run.begin), run.ink);
    return out;
}

TEST(Colors, EachKindOfWordHasItsOwn) {
    const std::string text =
        "#define K 2 // two\n"
        "surface x(float Kd = 0.5; string map = \"a.tx\") {\n"
        "    /* a\n       b */ Ci = Kd * noise(P); // end\n"
        "}";
    const std::vector<std::pair<std::string, Ink>> expected = {
        {"#define K 2 // two", Ink::Directive},
        {"surface", Ink::Keyword},
        {"float", Ink::Type},
        {"0.5", Ink::Number},
        {"string", Ink::Type},
        {"\"a.tx\"", Ink::String},
        {"/* a\n       b */", Ink::Comment},
        {"Ci", Ink::Global},
        {"noise", Ink::Builtin},
        {"P", Ink::Global},
        {"// end", Ink::Comment},
    };
    EXPECT_EQ(inks(text), expected);
}

TEST(Colors, UnfinishedTextsAreCovered) {
    for (std::string_view text :
         {"/* open", "\"open", "#", "# define\\\n more", "", "\xff\xfe", "'a"}) {
        size_t reached = 0;
        for (const InkRun& run : color_runs(text)) {
            EXPECT_LE(reached, run.begin) << text;
            EXPECT_LE(run.end, text.size()) << text;
            reached = run.end;
        }
    }
}

std::vector<std::string> names(std::string_view text, size_t least = 2) {
    std::vector<std::string> out;
    for (const Completion& offer : completions(text, text.size(), least)) out.push_back(offer.name);
    return out;
}

TEST(Completions, ComeFromTheRowsAndFromTheText) {
    EXPECT_EQ(names("Ci = smooths"), std::vector<std::string>{"smoothstep"});
    const auto found = names("float difference = 0; Ci = dif");
    EXPECT_EQ(found, (std::vector<std::string>{"diffuse", "difference"}));
    EXPECT_TRUE(names("Ci = d").empty()) << "one letter is not enough";
    EXPECT_FALSE(names("Ci = d", 0).empty());
    EXPECT_TRUE(completions("diffuse", 3, 2).empty()) << "within a word";
    EXPECT_TRUE(names("x = 12").empty());
}

TEST(Manual, SaysWhatTheNameIs) {
    EXPECT_NE(manual_line("mix").form.find("mix("), std::string::npos);
    EXPECT_EQ(manual_line("P").form, "point P");
    EXPECT_EQ(manual_line("P").text.substr(0, 9), "the point");
    EXPECT_EQ(manual_line("while").form, "while (condition) statement");
    EXPECT_TRUE(manual_line("no_such_name").form.empty());
}

}  // namespace
}  // namespace kinora::play
