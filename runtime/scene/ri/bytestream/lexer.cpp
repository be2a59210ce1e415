// runtime/scene/ri/bytestream/lexer.cpp: tokens of ASCII.
#include <algorithm>
#include <limits>

#include "collada/text/number_run.h"
#include "runtime/scene/ri/bytestream/lexer_p.h"

namespace kinora::ri {
namespace {

// Blanks, tabs and ends of lines; what else stands below them means nothing either.
bool is_blank(char c) {
    return uint8_t(c) <= ' ';
}

bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

bool delimits(char c) {
    return is_blank(c) || uint8_t(c) >= 0x80 || c == '[' || c == ']' || c == '"' || c == '#';
}

bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

bool same_letters(std::string_view word, std::string_view lower) {
    return std::ranges::equal(word, lower, {},
                              [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
}

// What printf writes for numbers that are none: "nan", "-inf", "-nan(ind)".
std::optional<double> non_finite(std::string_view word) {
    bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    word = word.substr(0, word.find('('));
    double value = std::numeric_limits<double>::quiet_NaN();
    if (same_letters(word, "inf") || same_letters(word, "infinity"))
        value = std::numeric_limits<double>::infinity();
    else if (!same_letters(word, "nan"))
        return std::nullopt;
    return negative ? -value : value;
}

struct EscapeRow {
    char letter, meaning;
};
constexpr EscapeRow kEscapes[] = {{'n', '\n'}, {'r', '\r'}, {'t', '\t'}, {'b', '\b'}, {'f', '\f'}};

bool is_octal(char c) {
    return c >= '0' && c <= '7';
}

}  // namespace

Lexer::Lexer(std::string_view stream)
    : begin_(stream.data()), at_(begin_), end_(begin_ + stream.size()) {}

void Lexer::take_numbers(std::vector<float>& values) {
    if (!ahead_) at_ = collada::append_floats(begin_, at_, end_, values);
}

void Lexer::take_numbers(std::vector<int>& values) {
    if (!ahead_) at_ = collada::append_ints(begin_, at_, end_, values);
}

void Lexer::skip_line(uint32_t at) {
    ahead_.reset();
    at_ = std::find_if(begin_ + at, end_, is_line_end);
}

// False: the stream ends.
bool Lexer::skip_blanks() {
    while (at_ < end_) {
        if (*at_ == '#')
            at_ = std::find_if(at_, end_, is_line_end);
        else if (is_blank(*at_))
            ++at_;
        else
            return true;
    }
    return false;
}

Token Lexer::scan() {
    Token token;
    do {  // definitions are no tokens
        bool more = skip_blanks();
        token = {};
        token.begin = uint32_t(at_ - begin_);
        if (more) uint8_t(*at_) >= 0x80 ? scan_encoded(token) : scan_ascii(token);
        token.end = uint32_t(at_ - begin_);
        if (!more) return token;
    } while (token.kind == TokenKind::End && at_ < end_);
    return token;
}

void Lexer::scan_ascii(Token& token) {
    if (*at_ == '[' || *at_ == ']') {
        token.kind = *at_++ == '[' ? TokenKind::Open : TokenKind::Close;
    } else if (*at_ == '"') {
        ++at_;
        scan_string(token, pool());
    } else if (const char* stop = collada::scan_number(at_, end_, token.number)) {
        token.kind = TokenKind::Number;
        token.whole =
            std::none_of(at_, stop, [](char c) { return c == '.' || c == 'e' || c == 'E'; });
        at_ = stop;
    } else {
        scan_word(token);
    }
}

void Lexer::scan_word(Token& token) {
    const char* stop = std::find_if(at_, end_, delimits);
    token.text = {at_, size_t(stop - at_)};
    at_ = stop;
    auto value = non_finite(token.text);
    token.kind = value ? TokenKind::Number : TokenKind::Word;
    token.number = value.value_or(0);
    if (value || is_letter(token.text[0])) return;
    token.kind = TokenKind::Bad;
    token.text = "a character that begins no token";
}

// The character behind a backslash, which is the one at_ stands on.
char Lexer::escaped() {
    if (is_octal(*at_)) {
        int value = 0;
        for (int digits = 0; digits < 3 && at_ < end_ && is_octal(*at_); ++digits)
            value = value * 8 + (*at_++ - '0');
        return char(value);
    }
    char c = *at_++;
    auto row = std::ranges::find(kEscapes, c, &EscapeRow::letter);
    return row == std::end(kEscapes) ? c : row->meaning;
}

// From behind the quotation mark.
void Lexer::scan_string(Token& token, TextPool& to) {
    const char* stop = at_;
    auto ends = [&](char c) { return c == '"' || (open_string_ && is_line_end(c)); };
    while (stop < end_ && !ends(*stop)) stop += *stop == '\\' && end_ - stop > 1 ? 2 : 1;
    if (stop == end_ || *stop != '"') {
        open_string_ = true;
        token.kind = TokenKind::Bad;
        token.text = "a string is not closed";
        at_ = std::find_if(at_, end_, is_line_end);
        return;
    }
    size_t most = size_t(stop - at_) + 1;
    char *text = to.take(most), *out = text;
    while (at_ < stop) {
        char c = *at_++;
        if (c == '\\' && is_line_end(*at_)) {
            bool two = *at_ == '\r' && at_[1] == '\n';
            at_ += two ? 2 : 1;
            continue;
        }
        *out++ = c == '\\' ? escaped() : c;
    }
    *out++ = 0;
    to.give_back(most - size_t(out - text));
    ++at_;
    token.kind = TokenKind::String;
    token.text = {text, size_t(out - text) - 1};
}

}  // namespace kinora::ri
