// rsl/parser.cpp: tokens, errors and recovery of the parser.
#include "rsl/parser.h"

#include <algorithm>

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
    {Punct::Arrow, ""},
    {Punct::Scope, ""},
    {Punct::BitAnd, "write '&&'"},
    {Punct::BitOr, "write '||'"},
    {Punct::ShiftLeft, ""},
    {Punct::ShiftRight, ""},
};

}  // namespace

void Parser::syntax_error(const char* expected) {
    if (panic_) return;
    const Token& at = token();
    for (const ForeignPunct& row : kForeign) {
        if (row.punct != at.punct) continue;
        Finding* finding = error(Code::RSL_NOT_RSL, at, describe(at));
        if (finding && *row.help) finding->help = row.help;
        return;
    }
    if (at.kind == TokenKind::Other)
        error(Code::RSL_BAD_CHARACTER, at, describe(at));
    else
        error(Code::RSL_SYNTAX, at, expected, describe(at));
}

bool Parser::expect(Punct punct, const char* what) {
    if (accept(punct)) return true;
    syntax_error(what);
    return false;
}

// A missing semicolon is reported behind the last token. Where the next token begins a line or ends
// a block, the statement was whole: nothing is skipped.
void Parser::expect_semicolon() {
    if (panic_ || accept(Punct::Semicolon)) return;
    bool whole = token().line_start || is(Punct::RightBrace) || at_end();
    if (!whole || next_ == 0) {
        syntax_error("';'");
        return;
    }
    const Token& last = ast_.tokens.tokens[next_ - 1];
    bool cut = last.kind == TokenKind::String && (last.text.size() < 2 || last.text.back() != '"');
    if (cut) return;  // the string without its end, reported already, has swallowed the semicolon
    Location behind{last.where.file, last.where.end, last.where.end};
    reporter_.report(Code::RSL_SYNTAX, behind, last.macro, last.spelling, "';'", describe(token()));
}

std::string_view Parser::expect_name(const char* what) {
    const Token& at = token();
    bool reserved = at.word != Word::None && at.word < Word::Illuminance;
    if (at.kind != TokenKind::Identifier || reserved) {
        syntax_error(what);
        return {};
    }
    advance();
    return at.text;
}

Place Parser::place_from(uint32_t first) const {
    const auto& tokens = ast_.tokens.tokens;
    return place_from(Place{tokens[first].where, first}, first);
}

// From `first` to the last token read; `token` is what stands for the node.
Place Parser::place_from(const Place& first, uint32_t token) const {
    Place place{first.where, token};
    if (next_ == 0) return place;
    const Location& last = ast_.tokens.tokens[next_ - 1].where;
    if (last.file == place.where.file) place.where.end = std::max(place.where.end, last.end);
    return place;
}

// ---- recovery -----------------------------------------------------------------------------------

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
        if (is(Punct::LeftBrace)) {
            skip_balanced(Punct::LeftBrace, Punct::RightBrace);
            return;
        }
        advance();
    }
}

void Parser::skip_definition() {
    panic_ = false;
    for (int depth = 0; !at_end() && !is(Punct::LeftBrace); advance()) {
        depth += is(Punct::LeftParen);
        depth -= is(Punct::RightParen);
        if (depth <= 0 && is(Punct::Semicolon)) break;
    }
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
        uint32_t before = next_;
        definition();
        if (panic_) skip_definition();
        if (next_ == before) advance();
    }
}

}  // namespace kinora::rsl
