// runtime/scene/ri/bytestream/lexer_p.h: the tokens of a stream in which ASCII and binary mix (RI
// Specification 3.2, appendix C).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/scene/ri/bytestream/text_pool_p.h"

namespace kinora::ri {

enum class TokenKind : uint8_t {
    End,
    Word,    // a request, or what would be one
    Number,  // nan and inf too
    String,
    Open,    // [
    Close,   // ]
    Floats,  // a whole array of singles
    Bad,     // none of these: `text` says why
};

struct Token {
    TokenKind kind = TokenKind::End;
    bool encoded = false;  // begins with a byte above 0177
    bool whole = false;    // a number without point and exponent
    uint32_t begin = 0, end = 0;
    double number = 0;
    // Of a string with a 0 behind it, until forget(). Of Floats their bytes, the highest first.
    std::string_view text;
};

class Lexer {
  public:
    // The stream outlives the lexer and is shorter than 4 GB.
    explicit Lexer(std::string_view stream);

    const Token& peek() {
        if (!ahead_) ahead_ = scan();
        return *ahead_;
    }
    Token take() {
        Token token = peek();
        ahead_.reset();
        return token;
    }
    // Short cuts for the numbers that come next, where nothing was peeked at. What stops them is
    // the next token.
    void take_numbers(std::vector<float>& values);
    void take_numbers(std::vector<int>& values);

    // Strings taken so far end, but for those of the stream's own table.
    void forget() { strings_.clear(); }
    std::string_view keep(std::string_view text) { return strings_.copy(text); }
    // Goes on behind the line of this byte.
    void skip_line(uint32_t at);

  private:
    struct CodeRow;

    Token scan();
    bool skip_blanks();
    void scan_ascii(Token& token);
    void scan_string(Token& token, TextPool& pool);
    void scan_word(Token& token);
    void scan_encoded(Token& token);
    char escaped();

    void encoded_integer(Token& token, int code);
    void encoded_short_string(Token& token, int code);
    void encoded_long_string(Token& token, int code);
    void encoded_real(Token& token, int code);
    void encoded_request(Token& token, int code);
    void encoded_floats(Token& token, int code);
    void define_request(Token& token, int code);
    void define_string(Token& token, int code);
    void defined_string(Token& token, int code);
    void end_of_input(Token& token, int code);

    // An unsigned number of so many bytes, the highest first; false, and a bad token, where the
    // stream ends before.
    bool operand(Token& token, size_t bytes, uint64_t& value);
    bool bytes_follow(Token& token, uint64_t count);
    void string_bytes(Token& token, uint64_t count);
    bool definition(Token& token, std::string_view& text);
    TextPool& pool() { return defining_ ? defined_ : strings_; }

    const char *begin_, *at_, *end_;
    std::optional<Token> ahead_;
    TextPool strings_, defined_;
    bool defining_ = false;     // the string being read is a definition's
    bool open_string_ = false;  // one was never closed: others end with their line
    std::array<std::string_view, 256> requests_{};
    std::vector<std::string_view> string_tokens_;
};

}  // namespace kinora::ri
