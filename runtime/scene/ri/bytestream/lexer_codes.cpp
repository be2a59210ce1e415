// runtime/scene/ri/bytestream/lexer_codes.cpp: tokens of binary streams (table C.1). Numbers have
// their highest byte first.
#include <bit>
#include <cmath>

#include "runtime/scene/ri/bytestream/lexer_p.h"

namespace kinora::ri {

// Bytes from `first` to `last` begin a token that is read by one function.
struct Lexer::CodeRow {
    int first, last;
    void (Lexer::*read)(Token& token, int code);  // code: from 0
};

void Lexer::scan_encoded(Token& token) {
    static constexpr CodeRow kCodes[] = {
        {0200, 0217, &Lexer::encoded_integer},     {0220, 0237, &Lexer::encoded_short_string},
        {0240, 0243, &Lexer::encoded_long_string}, {0244, 0245, &Lexer::encoded_real},
        {0246, 0246, &Lexer::encoded_request},     {0310, 0313, &Lexer::encoded_floats},
        {0314, 0314, &Lexer::define_request},      {0315, 0316, &Lexer::define_string},
        {0317, 0320, &Lexer::defined_string},      {0377, 0377, &Lexer::end_of_input},
    };
    int byte = uint8_t(*at_++);
    token.encoded = true;
    for (const CodeRow& row : kCodes)
        if (byte >= row.first && byte <= row.last)
            return (this->*row.read)(token, byte - row.first);
    token.kind = TokenKind::Bad;
    token.text = "a byte that begins no token";
}

bool Lexer::bytes_follow(Token& token, uint64_t count) {
    if (count <= uint64_t(end_ - at_)) return true;
    token.kind = TokenKind::Bad;
    token.text = "the stream ends inside of a token";
    at_ = end_;
    return false;
}

bool Lexer::operand(Token& token, size_t bytes, uint64_t& value) {
    if (!bytes_follow(token, bytes)) return false;
    value = 0;
    for (size_t i = 0; i < bytes; ++i) value = value << 8 | uint8_t(*at_++);
    return true;
}

// 4 d + w: a signed number of w + 1 bytes, the lowest d of which are its fraction.
void Lexer::encoded_integer(Token& token, int code) {
    int fraction = code / 4, bytes = code % 4 + 1;
    uint64_t bits;
    if (!operand(token, size_t(bytes), bits)) return;
    int unused = 64 - 8 * bytes;
    token.kind = TokenKind::Number;
    token.whole = fraction == 0;
    token.number = std::ldexp(double(int64_t(bits << unused) >> unused), -8 * fraction);
}

void Lexer::string_bytes(Token& token, uint64_t count) {
    if (!bytes_follow(token, count)) return;
    token.kind = TokenKind::String;
    token.text = pool().copy({at_, size_t(count)});
    at_ += count;
}

void Lexer::encoded_short_string(Token& token, int code) {
    string_bytes(token, uint64_t(code));
}

void Lexer::encoded_long_string(Token& token, int code) {
    uint64_t count;
    if (operand(token, size_t(code) + 1, count)) string_bytes(token, count);
}

void Lexer::encoded_real(Token& token, int code) {
    uint64_t bits;
    if (!operand(token, code ? 8 : 4, bits)) return;
    token.kind = TokenKind::Number;
    token.number =
        code ? std::bit_cast<double>(bits) : double(std::bit_cast<float>(uint32_t(bits)));
}

void Lexer::encoded_request(Token& token, int) {
    uint64_t code;
    if (!operand(token, 1, code)) return;
    token.kind = requests_[code].empty() ? TokenKind::Bad : TokenKind::Word;
    token.text = requests_[code].empty() ? "a request code that was not defined" : requests_[code];
}

void Lexer::encoded_floats(Token& token, int code) {
    uint64_t count;
    if (!operand(token, size_t(code) + 1, count) || !bytes_follow(token, 4 * count)) return;
    token.kind = TokenKind::Floats;
    token.text = {at_, size_t(4 * count)};
    at_ += 4 * count;
}

// The string of a definition, which may have any form; false, and a bad token: there is none.
bool Lexer::definition(Token& token, std::string_view& text) {
    int first = skip_blanks() ? uint8_t(*at_) : 0;
    bool is_string =
        first == '"' || (first >= 0220 && first <= 0243) || first == 0317 || first == 0320;
    Token string;
    defining_ = true;
    if (is_string) first == '"' ? scan_ascii(string) : scan_encoded(string);
    defining_ = false;
    text = string.text;
    if (string.kind == TokenKind::String) return true;
    token.kind = TokenKind::Bad;
    token.text = is_string ? string.text : "a definition without its string";
    return false;
}

void Lexer::define_request(Token& token, int) {
    uint64_t code;
    std::string_view name;
    if (operand(token, 1, code) && definition(token, name)) requests_[code] = name;
}

void Lexer::define_string(Token& token, int code) {
    uint64_t number;
    std::string_view text;
    if (!operand(token, size_t(code) + 1, number) || !definition(token, text)) return;
    if (number >= string_tokens_.size()) string_tokens_.resize(number + 1);
    string_tokens_[number] = text;
}

void Lexer::defined_string(Token& token, int code) {
    uint64_t number;
    if (!operand(token, size_t(code) + 1, number)) return;
    bool known = number < string_tokens_.size() && string_tokens_[number].data();
    token.kind = known ? TokenKind::String : TokenKind::Bad;
    token.text = known ? string_tokens_[number] : "a string token that was not defined";
}

// What RunProgram sends after an answer.
void Lexer::end_of_input(Token&, int) {
    end_ = at_;
}

}  // namespace kinora::ri
