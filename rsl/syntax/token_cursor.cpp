// rsl/syntax/token_cursor.cpp: looking ahead and going on.
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

bool TokenCursor::accept(Punct punct) {
    if (!is(punct)) return false;
    advance();
    return true;
}

bool TokenCursor::accept(Word word) {
    if (!is(word)) return false;
    advance();
    return true;
}

bool TokenCursor::after_reported() const {
    if (position_ == 0) return false;
    const Token& last = tokens_[position_ - 1];
    bool string = last.kind == TokenKind::String;
    return last.lost || (string && (last.text.size() < 2 || last.text.back() != '"'));
}

bool TokenCursor::is_reserved(int ahead) const {
    Word word = token(ahead).word;
    if (word == Word::None || word >= Word::Illuminance) return false;
    return !word_as_name(ahead);
}

bool TokenCursor::word_as_name(int ahead) const {
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

SourceSpan TokenCursor::span_from(uint32_t first) const {
    return span_from(SourceSpan{tokens_[first].where, first}, first);
}

SourceSpan TokenCursor::span_from(const SourceSpan& first, uint32_t token) const {
    SourceSpan span{first.where, token};
    if (position_ == 0) return span;
    const Location& last = tokens_[position_ - 1].where;
    if (last.file == span.where.file) span.where.end = std::max(span.where.end, last.end);
    return span;
}

void TokenCursor::skip_balanced(Punct open, Punct close) {
    int depth = 0;
    do {
        depth += is(open);
        depth -= is(close);
        advance();
    } while (depth > 0 && !at_end());
}

bool TokenCursor::begins_shader() const {
    bool shader = token().word >= Word::Surface && token().word <= Word::Deformation;
    return shader && token().line_start && token(1).kind == TokenKind::Identifier &&
           is(Punct::LeftParen, 2);
}

bool TokenCursor::begins_definition() const {
    if (!token().line_start || token(1).kind != TokenKind::Identifier) return false;
    return begins_shader() || (is_type() && is(Punct::LeftParen, 2));
}

uint32_t TokenCursor::after_parens(uint32_t open) const {
    int depth = 0;
    for (uint32_t i = open; i < tokens_.size(); ++i) {
        if (tokens_[i].punct == Punct::Semicolon && depth == 0) break;
        depth += tokens_[i].punct == Punct::LeftParen;
        depth -= tokens_[i].punct == Punct::RightParen;
        if (depth == 0) return i + 1;
        if (tokens_[i].punct == Punct::LeftBrace || tokens_[i].punct == Punct::RightBrace) break;
    }
    return uint32_t(tokens_.size() - 1);
}

}  // namespace kinora::rsl
