// rsl/text/lexer.cpp: text to raw tokens.
#include "rsl/text/lexer.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

namespace kinora::rsl {

namespace {

struct PunctRow {
    std::string_view text;
    Punct punct;
};
constexpr PunctRow kPuncts[] = {
#define PUNCT(name, text) {text, Punct::name},
#include "rsl/text/puncts.def"
#undef PUNCT
};

struct WordRow {
    std::string_view text;
    Word word;
};
constexpr WordRow kWords[] = {
#define WORD(name, text) {text, Word::name},
#include "rsl/text/words.def"
#undef WORD
};

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || (c & 0x80);
}
// Left in files by old editors: the end mark of DOS, no-break spaces in Latin-1 and UTF-8.
constexpr char kDosEnd = '\x1a', kNoBreak = '\xa0', kNoBreakLead = '\xc2';
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // also where texts were pasted

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
constexpr bool is_octal_digit(char c) {
    return c >= '0' && c <= '7';
}
constexpr bool is_hex_digit(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

// What word processors and web pages make of plain characters, in UTF-8 and Windows-1252.
constexpr struct {
    std::string_view text;
    const char* plain;
} kTypographic[] = {
    {"\xe2\x80\x9c", "\""}, {"\xe2\x80\x9d", "\""}, {"\xe2\x80\x9e", "\""}, {"\xe2\x80\x98", "\""},
    {"\xe2\x80\x99", "\""}, {"\xe2\x80\x93", "-"},  {"\xe2\x80\x94", "-"},  {"\xe2\x88\x92", "-"},
    {"\xc3\x97", "*"},      {"\x93", "\""},         {"\x94", "\""},         {"\x91", "\""},
    {"\x92", "\""},         {"\x96", "-"},          {"\x97", "-"},
};

}  // namespace

Word find_word(std::string_view text) {
    if (text.size() < 2 || text.size() > 14) return Word::None;
    for (const WordRow& row : kWords)
        if (row.text.front() == text.front() && row.text == text) return row.word;
    return Word::None;
}

std::string_view word_text(Word word) {
    for (const WordRow& row : kWords)
        if (row.word == word) return row.text;
    return "";
}

const char* plain_character(std::string_view text) {
    for (const auto& row : kTypographic)
        if (row.text == text) return row.plain;
    return "";
}

double number_value(std::string_view text, bool& too_large) {
    double value = 0;
    bool hex = text.size() > 2 && (text[1] == 'x' || text[1] == 'X');
    const char* begin = text.data() + (hex ? 2 : 0);
    auto format = hex ? std::chars_format::hex : std::chars_format::general;
    auto result = std::from_chars(begin, text.data() + text.size(), value, format);
    // 1e400 leaves no value and 1e-400 is 0: the sign of the exponent tells them apart.
    bool beyond = result.ec == std::errc::result_out_of_range;
    too_large = beyond && text.find('-') == std::string_view::npos;
    return beyond ? 0 : value;
}

Lexer::Lexer(std::string_view text, const SourceMap& map) : text_(text), map_(&map) {}

Lexer::Trouble Lexer::take_trouble(Location& where) {
    where = locate(trouble_begin_, trouble_begin_ + 1);
    return std::exchange(trouble_, Trouble::None);
}

Location Lexer::locate(size_t begin, size_t end) const {
    if (map_->segments.empty()) return {map_->file, uint32_t(begin), uint32_t(end)};
    return map_->location(uint32_t(begin), uint32_t(end));
}

// "\n", "\r\n" or "\r".
size_t Lexer::newline_length(size_t i) const {
    if (at(i) == '\n') return 1;
    if (at(i) == '\r') return at(i + 1) == '\n' ? 2 : 1;
    return 0;
}

// A backslash, blanks that editors leave behind, and a newline.
size_t Lexer::continuation_length(size_t i) const {
    if (at(i) != '\\') return 0;
    size_t after = i + 1;
    while (is_blank(at(after))) ++after;
    size_t newline = newline_length(after);
    return newline ? after + newline - i : 0;
}

// A single byte is one of Windows-1252 only where no character of UTF-8 goes on.
size_t Lexer::typographic_length(size_t i) const {
    if (!(at(i) & 0x80)) return 0;
    for (const auto& row : kTypographic) {
        bool alone = row.text.size() > 1 || i == 0 || !(at(i - 1) & 0x80);
        if (alone && text_.substr(i).starts_with(row.text)) return row.text.size();
    }
    return 0;
}

bool Lexer::skip_comment() {
    if (at(position_) != '/') return false;
    if (at(position_ + 1) == '/') {
        while (position_ < text_.size() && !newline_length(position_))
            position_ += std::max<size_t>(1, continuation_length(position_));
        return true;
    }
    if (at(position_ + 1) != '*') return false;
    size_t end = text_.find("*/", position_ + 2);
    if (end == std::string_view::npos) {
        trouble_ = Trouble::UnterminatedComment;
        trouble_begin_ = position_;
    }
    position_ = end == std::string_view::npos ? text_.size() : end + 2;
    return true;
}

bool Lexer::skip_space() {
    size_t begin = position_;
    while (position_ < text_.size()) {
        char c = text_[position_];
        if (is_blank(c) || c == '\0' || c == kDosEnd || c == kNoBreak) {
            ++position_;
        } else if (c == kNoBreakLead && at(position_ + 1) == kNoBreak) {
            position_ += 2;
        } else if (text_.substr(position_).starts_with(kByteOrderMark)) {
            position_ += kByteOrderMark.size();
        } else if (size_t newline = newline_length(position_)) {
            position_ += newline;
            line_start_ = true;
        } else if (size_t continued = continuation_length(position_)) {
            position_ += continued;
        } else if (!skip_comment()) {
            break;
        }
    }
    return position_ != begin;
}

Token Lexer::next() {
    Token token;
    token.space_before = skip_space();
    token.line_start = std::exchange(line_start_, false);
    size_t begin = position_;
    if (begin < text_.size()) {
        punct_ = Punct::None;
        token.kind = scan(begin);
        token.punct = punct_;
        token.text = text_.substr(begin, position_ - begin);
    } else {
        line_start_ = token.line_start = true;
    }
    token.where = token.spelling = locate(begin, position_);
    return token;
}

TokenKind Lexer::scan(size_t begin) {
    char c = text_[begin];
    if (size_t length = typographic_length(begin)) {
        position_ += length;
        punct_ = Punct::Other;
        return TokenKind::Other;
    }
    if (is_letter(c)) {
        while (is_letter(at(position_)) || is_digit(at(position_))) {
            bool blank = at(position_) == kNoBreakLead && at(position_ + 1) == kNoBreak;
            bool latin =
                at(position_) == kNoBreak && position_ > begin && !(at(position_ - 1) & 0x80);
            bool mark = at(position_) == kByteOrderMark[0] &&
                        text_.substr(position_).starts_with(kByteOrderMark);
            if (blank || latin || mark || typographic_length(position_)) break;
            ++position_;
        }
        return TokenKind::Identifier;
    }
    if (is_digit(c) || (c == '.' && is_digit(at(begin + 1)))) {
        scan_number();
        return TokenKind::Number;
    }
    if (c == '"') {
        scan_string();
        return TokenKind::String;
    }
    for (const PunctRow& row : kPuncts) {
        if (!text_.substr(begin).starts_with(row.text)) continue;
        position_ += row.text.size();
        punct_ = row.punct;
        return TokenKind::Punctuator;
    }
    position_ += std::max<size_t>(1, character_length(begin));
    punct_ = Punct::Other;
    return TokenKind::Other;
}

// Of one character or escape sequence between single quotes; 0 where there is none.
size_t Lexer::character_length(size_t i) const {
    constexpr char kQuote = '\'';
    if (at(i) != kQuote) return 0;
    size_t end = i + 1;
    if (at(end) == '\\') {
        ++end;
        auto more = [&](auto&& is_one, int most) {
            for (int k = 0; k < most && is_one(at(end)); ++k) ++end;
        };
        bool hex = at(end) == 'x', octal = is_octal_digit(at(end));
        if (!octal) ++end;
        if (octal) more(is_octal_digit, 3);
        if (hex) more(is_hex_digit, 8);
    } else if (at(end) != kQuote && at(end) >= ' ' && at(end) <= '~') {
        ++end;
    }
    return at(end) == kQuote && end > i + 1 ? end + 1 - i : 0;
}

void Lexer::scan_number() {
    auto digits = [&] {
        while (is_digit(at(position_))) ++position_;
    };
    bool hex = at(position_) == '0' && (at(position_ + 1) == 'x' || at(position_ + 1) == 'X');
    if (hex && is_hex_digit(at(position_ + 2))) {
        for (position_ += 2; is_hex_digit(at(position_));) ++position_;
        scan_suffix("uUlL");
        return;
    }
    digits();
    if (at(position_) == '.') {
        ++position_;
        digits();
    }
    size_t exponent = position_;
    if (at(exponent) == 'e' || at(exponent) == 'E') {
        ++exponent;
        if (at(exponent) == '+' || at(exponent) == '-') ++exponent;
        if (is_digit(at(exponent))) {
            position_ = exponent;
            digits();
        }
    }
    scan_suffix("fFuUlL");
}

// C's suffixes, tolerated: 0.5f, 16u, 10L, 1ull
void Lexer::scan_suffix(std::string_view letters) {
    size_t end = position_;
    while (end < text_.size() && end < position_ + 3 && letters.find(at(end)) != letters.npos)
        ++end;
    if (!is_letter(at(end)) && !is_digit(at(end))) position_ = end;
}

void Lexer::scan_string() {
    size_t begin = position_;
    for (++position_; position_ < text_.size(); ++position_) {
        if (text_[position_] == '"') {
            ++position_;
            return;
        }
        if (size_t continued = continuation_length(position_)) {
            position_ += continued - 1;
        } else if (newline_length(position_)) {
            if (size_t end = string_end_below(position_)) position_ = end;
            break;
        } else if (text_[position_] == '\\') {
            ++position_;
        }
    }
    position_ = std::min(position_, text_.size());
    trouble_ = Trouble::UnterminatedString;
    trouble_begin_ = begin;
}

// A string that goes on over lines, which is an error: behind its closing quote, the first one
// below `i` if that line has an odd number of them; else 0.
size_t Lexer::string_end_below(size_t i) const {
    constexpr int kMostLines = 20;
    size_t quote = text_.find('"', i);
    if (quote == std::string_view::npos) return 0;
    int lines = 0, quotes = 0;
    for (size_t k = i; k < quote; ++k) {
        if (!newline_length(k)) continue;
        ++lines;
        size_t first = k + newline_length(k);
        while (is_blank(at(first))) ++first;
        if (at(first) == '#') return 0;  // a directive must not be lost
    }
    for (size_t k = quote; k < text_.size() && !newline_length(k); ++k) quotes += text_[k] == '"';
    return quotes % 2 == 1 && lines <= kMostLines ? quote + 1 : 0;
}

std::string_view Lexer::rest_of_line() {
    size_t begin = position_;
    while (position_ < text_.size() && !newline_length(position_))
        position_ += std::max<size_t>(1, continuation_length(position_));
    position_ = std::min(position_, text_.size());
    std::string_view line = text_.substr(begin, position_ - begin);
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
}

namespace {

int octal_value(std::string_view text, size_t& i) {
    int value = 0;
    for (int n = 0; n < 3 && i < text.size() && is_octal_digit(text[i]); ++n)
        value = value * 8 + (text[i++] - '0');
    --i;
    return value & 0xff;
}

}  // namespace

std::string string_value(std::string_view quoted) {
    if (quoted.starts_with('"')) quoted.remove_prefix(1);
    if (quoted.ends_with('"')) quoted.remove_suffix(1);
    constexpr std::string_view kEscapes = "ntrbfv", kMeanings = "\n\t\r\b\f\v";
    std::string value;
    value.reserve(quoted.size());
    for (size_t i = 0; i < quoted.size(); ++i) {
        if (quoted[i] != '\\' || i + 1 == quoted.size()) {
            value += quoted[i];
            continue;
        }
        char c = quoted[++i];
        size_t escape = kEscapes.find(c);
        if (escape != std::string_view::npos) {
            value += kMeanings[escape];
        } else if (is_octal_digit(c)) {
            value += char(octal_value(quoted, i));
        } else if (c == '\n' || c == '\r' || c == ' ' || c == '\t') {
            size_t end = quoted.find('\n', i);  // a continued line
            i = end == std::string_view::npos ? i : end;
        } else {
            value += c;
        }
    }
    return value;
}

// Escapes are those of strings, besides C's \a, \? and \xnn.
int character_value(std::string_view quoted) {
    std::string_view inside = quoted.substr(1, quoted.size() - 2);
    if (inside.starts_with("\\a")) return 7;
    if (inside.starts_with("\\x")) {
        unsigned value = 0;
        std::from_chars(inside.data() + 2, inside.data() + inside.size(), value, 16);
        return static_cast<signed char>(value);
    }
    std::string text = string_value('"' + std::string(inside) + '"');
    return static_cast<signed char>(inside[0] == '\\' && !text.empty() ? text[0] : inside[0]);
}

}  // namespace kinora::rsl
