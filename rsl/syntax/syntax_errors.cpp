// rsl/syntax/syntax_errors.cpp: what is said of a token that does not fit, and what is skipped.
#include "rsl/syntax/syntax_errors.h"

#include <algorithm>

#include "rsl/text/lexer.h"

namespace kinora::rsl {

namespace {

std::string describe(const Token& token) {
    if (token.kind == TokenKind::End) return "the end of the file";
    if (token.kind == TokenKind::String) return fmt::format("string {}", token.text);
    return fmt::format("'{}'", token.text);
}

// Constructs of other languages that people write, with what to write instead.
struct ForeignPunct {
    Punct punct;
    const char* help;
};
constexpr ForeignPunct kForeign[] = {
    {Punct::Increment, "write 'i += 1'"},
    {Punct::Decrement, "write 'i -= 1'"},
    {Punct::Modulo, "write 'mod(a, b)'"},
    {Punct::Scope, ""},
    {Punct::BitAnd, "write '&&'"},
    {Punct::BitOr, "write '||'"},
    {Punct::ShiftLeft, ""},
    {Punct::ShiftRight, ""},
};

std::string character_help(std::string_view text) {
    if (text.starts_with("'")) return "write strings between \" and \"";
    const char* plain = plain_character(text);
    return *plain ? fmt::format("write a plain {}", plain) : "";
}

}  // namespace

void SyntaxErrors::syntax_error(const char* expected) {
    if (panic_) return;
    const Token& at = cursor_.token();
    if (cursor_.after_reported()) {  // and it has swallowed what is missed here
        panic_ = true;
        mark_broken();
        return;
    }
    if (foreign_character()) return;
    if (at.punct == Punct::Arrow) {
        newer_language(at, "'->' behind something other than a variable");
        return;
    }
    for (const ForeignPunct& row : kForeign) {
        if (row.punct != at.punct) continue;
        Finding* finding = error(Code::RSL_NOT_RSL, at, describe(at));
        if (finding && *row.help) finding->help = row.help;
        return;
    }
    bool other = at.kind == TokenKind::Other;
    Finding* finding = other ? error(Code::RSL_BAD_CHARACTER, at, describe(at))
                             : error(Code::RSL_SYNTAX, at, expected, describe(at));
    if (finding && other) finding->help = character_help(at.text);
    if (!finding) return;
    if (behind_nested_comment()) finding->help = "comments do not nest: the first */ ends them";
    bool triple = at.punct == Punct::LeftBrace || at.punct == Punct::LeftBracket;
    if (triple && std::string_view(expected) == "an expression")
        finding->help = "a triple is written (a, b, c); only the first values of an array {a, b}";
    if (!meant_.empty()) finding->help = fmt::format("did you mean '{}'?", meant_);
}

// A "*/" near by, before the next ';' or brace.
bool SyntaxErrors::behind_nested_comment() const {
    constexpr int kNear = 40;
    for (int k = 0; k < kNear && cursor_.token(k).kind != TokenKind::End; ++k) {
        Punct punct = cursor_.token(k).punct;
        if (punct == Punct::Multiply && cursor_.is(Punct::Divide, k + 1) &&
            !cursor_.token(k + 1).space_before)
            return true;
        if (punct == Punct::LeftBrace || punct == Punct::RightBrace) return false;
    }
    return false;
}

bool SyntaxErrors::expect(Punct punct, const char* what) {
    if (cursor_.accept(punct)) return true;
    syntax_error(what);
    return false;
}

// A letter that no keyword has, where the grammar is broken: most likely a slip of the hand.
bool SyntaxErrors::foreign_character() {
    for (uint32_t k : {cursor_.position(), cursor_.position() > 0 ? cursor_.position() - 1 : 0}) {
        const Token& at = cursor_.at(k);
        bool foreign =
            at.kind == TokenKind::Identifier &&
            std::any_of(at.text.begin(), at.text.end(), [](char c) { return (c & 0x80) != 0; });
        if (!foreign) continue;
        error(Code::RSL_BAD_CHARACTER, at, fmt::format("'{}'", at.text));
        return true;
    }
    return false;
}

bool SyntaxErrors::newer_language(const Token& at, const char* feature) {
    if (stopped_) return true;
    error(Code::RSL_2, at, feature);
    panic_ = stopped_ = true;
    cursor_.move_to_end();
    reporter_.stop();
    return true;
}

// A missing semicolon is reported behind the last token. Where the next token begins a line or ends
// a block, the statement was whole: nothing is skipped.
void SyntaxErrors::expect_semicolon() {
    if (panic_ || cursor_.accept(Punct::Semicolon)) return;
    bool whole = cursor_.token().line_start || cursor_.is(Punct::RightBrace) || cursor_.at_end();
    if (cursor_.position() > 0 && whole) return missing_behind("';'");
    if (cursor_.position() > 0 && cursor_.at(cursor_.position() - 1).lost) return;
    syntax_error("';'");
}

void SyntaxErrors::missing_behind(const char* expected) {
    if (cursor_.after_reported()) return;  // it has swallowed what is missing
    const Token& last = cursor_.at(cursor_.position() - 1);
    Location behind{last.where.file, last.where.end, last.where.end};
    reporter_.report(Code::RSL_SYNTAX, behind, last.macro, last.spelling, expected,
                     describe(cursor_.token()));
}

std::string_view SyntaxErrors::expect_name(const char* what) {
    const Token& at = cursor_.token();
    if (at.kind != TokenKind::Identifier || cursor_.is_reserved()) {
        meant_ = decimal_comma();
        syntax_error(what);
        meant_.clear();
        return {};
    }
    cursor_.advance();
    return at.text;
}

// "float a = 0,5": the number that is meant; "" elsewhere.
std::string SyntaxErrors::decimal_comma() const {
    if (cursor_.token().kind != TokenKind::Number || cursor_.token().space_before ||
        cursor_.position() < 2)
        return "";
    const Token& comma = cursor_.at(cursor_.position() - 1);
    const Token& whole = cursor_.at(cursor_.position() - 2);
    bool whole_numbers = whole.text.find('.') == whole.text.npos &&
                         cursor_.token().text.find('.') == cursor_.token().text.npos;
    if (comma.punct != Punct::Comma || whole.kind != TokenKind::Number || !whole_numbers) return "";
    return fmt::format("{}.{}", whole.text, cursor_.token().text);
}

// ---- recovery -----------------------------------------------------------------------------------

void SyntaxErrors::begin_definition() {
    panic_ = false;
    recovery_.begin_definition(cursor_.position());
}

void SyntaxErrors::mark_broken() {
    ++breaks_;
    recovery_.break_definition();
}

void SyntaxErrors::lose(uint32_t begin, bool declares, bool whole_file) {
    recovery_.lose(cursor_.all(), begin, cursor_.position(), declares, whole_file);
}

void SyntaxErrors::resume_at(uint32_t position, uint32_t begin, bool declares) {
    cursor_.move_to(position);
    panic_ = false;
    lose(begin, declares);
}

namespace {

bool begins_statement(const Token& token) {
    return token.word >= Word::Float && token.word <= Word::Gather && token.word != Word::Else;
}

}  // namespace

// To the end of the broken statement: behind its ';', or before a '}' or a line that surely begins
// another statement.
void SyntaxErrors::skip_statement() {
    panic_ = false;
    for (bool first = true; !cursor_.at_end() && !cursor_.is(Punct::RightBrace); first = false) {
        if (cursor_.accept(Punct::Semicolon)) return;
        if (!first && cursor_.token().line_start && begins_statement(cursor_.token())) return;
        if (cursor_.begins_shader()) return;
        if (cursor_.is(Punct::LeftBrace)) {
            cursor_.skip_balanced(Punct::LeftBrace, Punct::RightBrace);
            return;
        }
        cursor_.advance();
    }
}

void SyntaxErrors::leave_statement(uint32_t begin) {
    if (!panic_) return;
    skip_statement();
    lose(begin);
}

void SyntaxErrors::skip_definition() {
    panic_ = false;
    for (bool first = true; !cursor_.at_end() && !cursor_.is(Punct::LeftBrace);
         first = false, cursor_.advance())
        if (!first && cursor_.begins_definition()) return;
    if (cursor_.is(Punct::LeftBrace)) cursor_.skip_balanced(Punct::LeftBrace, Punct::RightBrace);
    while (cursor_.accept(Punct::Semicolon)) {
    }
}

void SyntaxErrors::leave_definition(uint32_t begin) {
    if (!panic_) return;
    skip_definition();
    lose(begin, false, true);
}

}  // namespace kinora::rsl
