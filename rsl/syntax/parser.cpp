// rsl/syntax/parser.cpp: tokens, errors and recovery of the parser.
#include "rsl/syntax/parser.h"

#include <algorithm>

#include "rsl/text/lexer.h"

namespace kinora::rsl {

const Token& Parser::token(int ahead) const {
    size_t i = std::min(size_t(next_) + size_t(ahead), ast_.tokens.tokens.size() - 1);
    return ast_.tokens.tokens[i];
}

bool Parser::accept(Punct punct) {
    if (!is(punct)) return false;
    advance();
    return true;
}

bool Parser::accept(Word word) {
    if (!is(word)) return false;
    advance();
    return true;
}

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

void Parser::syntax_error(const char* expected) {
    if (panic_) return;
    const Token& at = token();
    if (after_reported()) {  // and it has swallowed what is missed here
        panic_ = true;
        mark_broken();
        return;
    }
    if (foreign_character()) return;
    if (at.punct == Punct::Arrow) {
        newer_language(at, "'->' (calls and members of shader objects)");
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
bool Parser::behind_nested_comment() const {
    constexpr int kNear = 40;
    for (int k = 0; k < kNear && token(k).kind != TokenKind::End; ++k) {
        Punct punct = token(k).punct;
        if (punct == Punct::Multiply && is(Punct::Divide, k + 1) && !token(k + 1).space_before)
            return true;
        if (punct == Punct::LeftBrace || punct == Punct::RightBrace) return false;
    }
    return false;
}

bool Parser::expect(Punct punct, const char* what) {
    if (accept(punct)) return true;
    syntax_error(what);
    return false;
}

// Whether the last token is a string without its end or a macro's lost use: both are reported.
bool Parser::after_reported() const {
    if (next_ == 0) return false;
    const Token& last = ast_.tokens.tokens[next_ - 1];
    bool string = last.kind == TokenKind::String;
    return last.lost || (string && (last.text.size() < 2 || last.text.back() != '"'));
}

// A missing semicolon is reported behind the last token. Where the next token begins a line or ends
// a block, the statement was whole: nothing is skipped.
void Parser::expect_semicolon() {
    if (panic_ || accept(Punct::Semicolon)) return;
    bool whole = token().line_start || is(Punct::RightBrace) || at_end();
    if (next_ > 0 && whole) return missing_behind("';'");
    if (next_ > 0 && ast_.tokens.tokens[next_ - 1].lost) return;
    syntax_error("';'");
}

// What is missing between the last token and this one, where both are whole.
void Parser::missing_behind(const char* expected) {
    if (after_reported()) return;  // it has swallowed what is missing
    const Token& last = ast_.tokens.tokens[next_ - 1];
    Location behind{last.where.file, last.where.end, last.where.end};
    reporter_.report(Code::RSL_SYNTAX, behind, last.macro, last.spelling, expected,
                     describe(token()));
}

std::string_view Parser::expect_name(const char* what) {
    const Token& at = token();
    if (at.kind != TokenKind::Identifier || is_reserved()) {
        meant_ = decimal_comma();
        syntax_error(what);
        meant_.clear();
        return {};
    }
    advance();
    return at.text;
}

// Control words always are words; types and details only where they can begin something.
bool Parser::is_reserved(int ahead) const {
    Word word = token(ahead).word;
    if (word == Word::None || word >= Word::Illuminance) return false;
    return !word_as_name(ahead);
}

// A type or detail that cannot be one here, since what follows continues or ends an expression or a
// declaration: "color = 1", "normal . I", "float point;".
bool Parser::word_as_name(int ahead) const {
    if (token(ahead).word < Word::Float || token(ahead).word > Word::Output) return false;
    switch (token(ahead + 1).punct) {
        case Punct::Assign:
        case Punct::AddAssign:
        case Punct::SubtractAssign:
        case Punct::MultiplyAssign:
        case Punct::DivideAssign:
        case Punct::Equal:
        case Punct::NotEqual:
        case Punct::Less:
        case Punct::LessEqual:
        case Punct::Greater:
        case Punct::GreaterEqual:
        case Punct::And:
        case Punct::Or:
        case Punct::Multiply:
        case Punct::Divide:
        case Punct::Dot:
        case Punct::Cross:
        case Punct::Question:
        case Punct::Colon:
        case Punct::Comma:
        case Punct::Semicolon:
        case Punct::RightParen:
        case Punct::LeftBracket:
        case Punct::RightBracket:
            return true;
        default:
            return false;
    }
}

SourceSpan Parser::span_from(uint32_t first) const {
    const auto& tokens = ast_.tokens.tokens;
    return span_from(SourceSpan{tokens[first].where, first}, first);
}

// From `first` to the last token read; `token` is what stands for the node.
SourceSpan Parser::span_from(const SourceSpan& first, uint32_t token) const {
    SourceSpan span{first.where, token};
    if (next_ == 0) return span;
    const Location& last = ast_.tokens.tokens[next_ - 1].where;
    if (last.file == span.where.file) span.where.end = std::max(span.where.end, last.end);
    return span;
}

// ---- recovery -----------------------------------------------------------------------------------

void Parser::mark_broken() {
    recovery_.break_definition();
    for (Function* f = function_; f; f = f->parent) f->damaged = true;
}

// The tokens from `begin` on to here are not in the tree.
void Parser::lose(uint32_t begin, bool parameters) {
    recovery_.lose(ast_.tokens.tokens, begin, next_, parameters, false);
}

void Parser::skip_balanced(Punct open, Punct close) {
    int depth = 0;
    do {
        depth += is(open);
        depth -= is(close);
        advance();
    } while (depth > 0 && !at_end());
}

namespace {

bool begins_statement(const Token& token) {
    return token.word >= Word::Float && token.word <= Word::Gather && token.word != Word::Else;
}

}  // namespace

// To the end of the broken statement: behind its ';', or before a '}' or a line that surely begins
// another statement.
void Parser::skip_statement() {
    panic_ = false;
    for (bool first = true; !at_end() && !is(Punct::RightBrace); first = false) {
        if (accept(Punct::Semicolon)) return;
        if (!first && token().line_start && begins_statement(token())) return;
        if (begins_shader()) return;
        if (is(Punct::LeftBrace)) {
            skip_balanced(Punct::LeftBrace, Punct::RightBrace);
            return;
        }
        advance();
    }
}

// After an error in the statement that begins at the token.
void Parser::leave_statement(uint32_t begin) {
    if (!panic_) return;
    skip_statement();
    lose(begin);
}

// A line that surely begins another shader.
bool Parser::begins_shader() const {
    bool shader = token().word >= Word::Surface && token().word <= Word::Deformation;
    return shader && token().line_start && token(1).kind == TokenKind::Identifier &&
           is(Punct::LeftParen, 2);
}

// A line that surely begins another shader or function.
bool Parser::begins_definition() const {
    if (!token().line_start || token(1).kind != TokenKind::Identifier) return false;
    return begins_shader() || (is_type() && is(Punct::LeftParen, 2));
}

void Parser::skip_definition() {
    panic_ = false;
    for (bool first = true; !at_end() && !is(Punct::LeftBrace); first = false, advance())
        if (!first && begins_definition()) return;
    if (is(Punct::LeftBrace)) skip_balanced(Punct::LeftBrace, Punct::RightBrace);
    while (accept(Punct::Semicolon)) {
    }
}

// Index of the token behind the ')' that closes the '(' at `open`; the end token if none does.
uint32_t Parser::after_parens(uint32_t open) const {
    const auto& tokens = ast_.tokens.tokens;
    int depth = 0;
    for (uint32_t i = open; i < tokens.size(); ++i) {
        if (tokens[i].punct == Punct::Semicolon && depth == 0) break;
        depth += tokens[i].punct == Punct::LeftParen;
        depth -= tokens[i].punct == Punct::RightParen;
        if (depth == 0) return i + 1;
        if (tokens[i].punct == Punct::LeftBrace || tokens[i].punct == Punct::RightBrace) break;
    }
    return uint32_t(tokens.size() - 1);
}

void Parser::run() {
    while (!at_end() && !reporter_.full()) {
        uint32_t begin = next_;
        panic_ = false;
        recovery_.begin_definition(begin);
        definition();
        if (panic_) {
            skip_definition();
            recovery_.lose(ast_.tokens.tokens, begin, next_, false, true);
        }
        if (next_ == begin) advance();
    }
}

}  // namespace kinora::rsl
