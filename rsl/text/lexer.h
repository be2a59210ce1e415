// rsl/text/lexer.h: text to raw tokens, one file at a time, before macros.
#pragma once

#include <string_view>

#include "rsl/text/token.h"
#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

// Reads tokens in order. Comments, white space and line continuations are skipped. Copyable: a copy
// looks ahead. Bad input never stops it: an unterminated string or comment ends at the line's or
// file's end and sets `trouble`.
class Lexer {
  public:
    enum class Trouble : uint8_t { None, UnterminatedString, UnterminatedComment };

    // `text` and `map` must outlive the lexer and its tokens.
    Lexer(std::string_view text, const SourceMap& map);

    Token next();  // an End token at the end, again and again
    // What was wrong with the text up to the last token, once; `where` gets its location.
    Trouble take_trouble(Location& where);

    // The rest of the line as text, trimmed, comments included; the lexer goes on at the next line.
    std::string_view rest_of_line();
    Location here() const { return locate(position_, position_); }

  private:
    bool skip_space();
    bool skip_comment();
    size_t newline_length(size_t at) const;
    size_t continuation_length(size_t at) const;
    size_t typographic_length(size_t at) const;
    size_t string_end_below(size_t at) const;
    TokenKind scan(size_t begin);
    size_t character_length(size_t at) const;
    void scan_number();
    void scan_suffix(std::string_view letters);
    void scan_string();
    Location locate(size_t begin, size_t end) const;
    char at(size_t i) const { return i < text_.size() ? text_[i] : '\0'; }

    std::string_view text_;
    const SourceMap* map_;
    size_t position_ = 0;
    bool line_start_ = true;
    Trouble trouble_ = Trouble::None;
    size_t trouble_begin_ = 0;
    Punct punct_ = Punct::None;
};

// The meaning of an identifier.
Word find_word(std::string_view text);
std::string_view word_text(Word word);

// The character that a typographic one (a curly quote, a dash) stands for; "" for all others.
const char* plain_character(std::string_view text);

// The value of a Number token, which may be hexadecimal and have a suffix of C.
double number_value(std::string_view text, bool& too_large);

// A character between single quotes, as C writes it; only #if has a meaning for it.
inline bool is_character_constant(const Token& token) {
    return token.kind == TokenKind::Other && token.text.size() > 2 && token.text[0] == '\'';
}
int character_value(std::string_view quoted);

// The value of a String token: quotes off, escapes (\n \t \\ \" \nnn ...) decoded, continued lines
// joined.
std::string string_value(std::string_view quoted);

}  // namespace kinora::rsl
