// tests/rsl/lexer_test.cpp: raw tokens.
#include "rsl/text/lexer.h"

#include <gtest/gtest.h>

namespace kinora::rsl {
namespace {

std::vector<Token> lex(std::string_view text) {
    static const SourceMap map;
    Lexer lexer(text, map);
    std::vector<Token> tokens;
    for (Token t = lexer.next(); t.kind != TokenKind::End; t = lexer.next()) tokens.push_back(t);
    return tokens;
}

TEST(Lexer, ReadsNumbersInAllSpellings) {
    for (const char* text : {"1", "1.", ".5", "1e3", "1.5E-3", "0.5f", "1e+9"}) {
        auto tokens = lex(text);
        ASSERT_EQ(tokens.size(), 1u) << text;
        EXPECT_EQ(tokens[0].kind, TokenKind::Number);
        EXPECT_EQ(tokens[0].text, text);
    }
}

TEST(Lexer, ADotBetweenNamesIsAnOperator) {
    auto tokens = lex("I.N");
    ASSERT_EQ(tokens.size(), 3u);
    EXPECT_EQ(tokens[1].punct, Punct::Dot);
}

TEST(Lexer, TakesTheLongestPunctuator) {
    auto tokens = lex("a+=b<=c==d");
    ASSERT_EQ(tokens.size(), 7u);
    EXPECT_EQ(tokens[1].punct, Punct::AddAssign);
    EXPECT_EQ(tokens[3].punct, Punct::LessEqual);
    EXPECT_EQ(tokens[5].punct, Punct::Equal);
}

TEST(Lexer, SkipsCommentsAndContinuedLines) {
    auto tokens = lex("a /* b\n c */ d // e \\\n f\n g \\\n h");
    ASSERT_EQ(tokens.size(), 4u);
    EXPECT_EQ(tokens[1].text, "d");
    EXPECT_TRUE(tokens[2].line_start);
    EXPECT_EQ(tokens[3].text, "h");
    EXPECT_FALSE(tokens[3].line_start);
}

TEST(Lexer, EveryLineEndingEndsALine) {
    for (const char* text : {"a\nb", "a\r\nb", "a\rb"}) {
        auto tokens = lex(text);
        ASSERT_EQ(tokens.size(), 2u);
        EXPECT_TRUE(tokens[1].line_start);
    }
}

TEST(Lexer, AByteOrderMarkIsSpaceWhereverItIsPasted) {
    auto tokens =
        lex("\xef\xbb\xbf#a\n\xef\xbb\xbf"
            "b\xef\xbb\xbf");
    ASSERT_EQ(tokens.size(), 3u);
    EXPECT_EQ(tokens[0].text, "#");
    EXPECT_TRUE(tokens[0].line_start);
    EXPECT_EQ(tokens[2].text, "b");
    EXPECT_TRUE(tokens[2].line_start);
}

TEST(Lexer, DecodesEscapesOfStrings) {
    EXPECT_EQ(string_value(R"("a\n\"b\"\\\101")"), "a\n\"b\"\\A");
    EXPECT_EQ(string_value("\"ab\\\ncd\""), "abcd");
}

TEST(Lexer, AnOpenStringEndsWithItsLine) {
    static const SourceMap map;
    Lexer lexer("\"abc\nd", map);
    EXPECT_EQ(lexer.next().text, "\"abc");
    Location where;
    EXPECT_EQ(lexer.take_trouble(where), Lexer::Trouble::UnterminatedString);
    EXPECT_EQ(lexer.next().text, "d");
}

TEST(Lexer, PlacesGoThroughTheSourceMap) {
    SourceMap map;
    map.file = 7;
    map.segments = {{0, 100}, {2, 110}};  // "a " stands at 100, "bc" at 110 (an entity between)
    Lexer lexer("a bc", map);
    EXPECT_EQ(lexer.next().where.begin, 100u);
    Location bc = lexer.next().where;
    EXPECT_EQ(bc.file, 7u);
    EXPECT_EQ(bc.begin, 110u);
    EXPECT_EQ(bc.end, 112u);
}

}  // namespace
}  // namespace kinora::rsl
