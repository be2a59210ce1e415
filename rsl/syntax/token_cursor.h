// rsl/syntax/token_cursor.h: the point that the parser has reached in the tokens.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rsl/syntax/ast.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

class TokenCursor {
  public:
    // The tokens end with an End token, which is never left.
    explicit TokenCursor(std::vector<Token>& tokens, uint32_t first = 0)
        : tokens_(tokens), position_(first) {}

    const Token& token(int ahead = 0) const {
        return tokens_[std::min(size_t(position_) + size_t(ahead), tokens_.size() - 1)];
    }
    bool is(Punct punct, int ahead = 0) const { return token(ahead).punct == punct; }
    bool is(Word word, int ahead = 0) const { return token(ahead).word == word; }
    bool at_end() const { return token().kind == TokenKind::End; }
    bool is_type(int ahead = 0) const {
        return token(ahead).word >= Word::Float && token(ahead).word <= Word::Void;
    }
    bool is_detail(int ahead = 0) const {
        return (token(ahead).word >= Word::Uniform && token(ahead).word <= Word::Output) ||
               is_constant(ahead);
    }
    // RSL 2.0's "constant float": elsewhere the word is a name.
    bool is_constant(int ahead = 0) const {
        bool type = is_type(ahead + 1) || token(ahead + 1).text == "shader";
        return token(ahead).text == "constant" && (type || is_storage(ahead + 1)) &&
               token(ahead + 2).kind == TokenKind::Identifier;
    }
    // RSL 2.0's "shader" before a name: a handle.
    bool is_handle(int ahead = 0) const {
        return token(ahead).text == "shader" && token(ahead + 1).kind == TokenKind::Identifier &&
               !is_reserved(ahead + 1);
    }
    bool is_storage(int ahead = 0) const {
        return token(ahead).word >= Word::Uniform && token(ahead).word <= Word::Output;
    }
    // Control words always are words; types and details only where they can begin something.
    bool is_reserved(int ahead = 0) const;
    // A type or detail that cannot be one here, since what follows continues or ends an expression
    // or a declaration: "color = 1", "normal . I", "float point;".
    bool word_as_name(int ahead = 0) const;
    // A line that surely begins another shader, or another shader or function.
    bool begins_shader() const;
    bool begins_definition() const;

    void advance() { position_ += !at_end(); }
    bool accept(Punct punct);
    bool accept(Word word);
    // The token was meant to be this word.
    void take_as(Word word) { tokens_[position_].word = word; }
    // From an opening token on to behind the one that closes it.
    void skip_balanced(Punct open, Punct close);

    // Tokens by their index.
    const std::vector<Token>& all() const { return tokens_; }
    const Token& at(uint32_t index) const { return tokens_[index]; }
    uint32_t position() const { return position_; }
    void move_to(uint32_t position) { position_ = position; }
    void move_to_end() { position_ = uint32_t(tokens_.size() - 1); }
    // Index of the token behind the ')' that closes the '(' at `open`; the end token if none does.
    uint32_t after_parens(uint32_t open) const;
    // Whether the last token is a string without its end or a macro's lost use: both are reported.
    bool after_reported() const;

    // From `first` to the last token read.
    SourceSpan span_from(uint32_t first) const;
    // The same; `token` is what stands for the node.
    SourceSpan span_from(const SourceSpan& first, uint32_t token) const;

  private:
    std::vector<Token>& tokens_;
    uint32_t position_;
};

}  // namespace kinora::rsl
