// collada/text/words.cpp: the forms of one word: names, URIs, dates.
#include <algorithm>
#include <array>
#include <cstring>

#include "collada/text/words_p.h"

namespace kinora::collada {

namespace {

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_hex(char c) {
    return is_digit(c) || ((c | 32) >= 'a' && (c | 32) <= 'f');
}
constexpr bool starts_name(char c) {
    return is_letter(c) || c == '_';
}
constexpr auto kNameBytes = [] {  // ASCII that may follow
    std::array<bool, 256> t{};
    for (int c = 0; c < 128; ++c)
        t[size_t(c)] = starts_name(char(c)) || is_digit(char(c)) || c == '-' || c == '.';
    return t;
}();

// A character of two bytes or more, which `p` moves behind; 0 where it is none.
uint32_t take_character(const char*& p, const char* end) {
    uint8_t lead = uint8_t(*p);
    int length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC0 || end - p < length) return 0;
    uint32_t c = lead & (0x7F >> length);
    for (int i = 1; i < length; ++i) c = c << 6 | (uint8_t(p[i]) & 0x3F);
    p += length;
    return c;
}

// A letter, then letters, digits and the like; `colons`: ':' anywhere, too.
bool is_name_of(std::string_view word, bool colons) {
    const char *p = word.data(), *end = p + word.size();
    if (p == end) return false;
    if (uint8_t(*p) >= 0x80) {
        if (!is_letter_beyond_ascii(take_character(p, end))) return false;
    } else if (!starts_name(*p) && !(colons && *p == ':')) {
        return false;
    }
    while (true) {
        while (p < end && kNameBytes[uint8_t(*p)]) ++p;
        if (p == end) return true;
        if (uint8_t(*p) >= 0x80) {
            if (!follows_in_name_beyond_ascii(take_character(p, end))) return false;
        } else if (colons && *p == ':') {
            ++p;
        } else {
            return false;
        }
    }
}

// What a segment of a path may hold, what an IRI may hold besides, and what anyURI lets be written
// unescaped.
constexpr auto kPathBytes = [] {
    std::array<bool, 256> t{};
    for (int c = 0; c < 256; ++c)
        t[size_t(c)] = c < 32 || c >= 128 || is_letter(char(c)) || is_digit(char(c));
    for (char c : std::string_view("-._~!$&'()*+,;=:@ <>\"{}|\\^`")) t[uint8_t(c)] = true;
    return t;
}();

// Reads a URI reference by the grammar of RFC 3986.
class Uri {
  public:
    explicit Uri(std::string_view text) : p_(text.data()), end_(text.data() + text.size()) {}

    bool whole() {
        const char* start = p_;
        if (scheme()) {
            if (!hierarchy(true)) return false;
        } else {
            p_ = start;
            if (!hierarchy(false)) return false;
        }
        if (at('?')) ++p_, run("/?");
        if (at('#')) ++p_, run("/?[]");
        return p_ == end_;
    }

  private:
    bool at(char c) const { return p_ < end_ && *p_ == c; }

    bool scheme() {
        if (p_ == end_ || !is_letter(*p_)) return false;
        while (p_ < end_ && (is_letter(*p_) || is_digit(*p_) || std::strchr("+-.", *p_))) ++p_;
        if (!at(':')) return false;
        ++p_;
        return true;
    }

    // "//" authority path | path; without a scheme the first segment has no ':'.
    bool hierarchy(bool has_scheme) {
        if (end_ - p_ >= 2 && p_[0] == '/' && p_[1] == '/') {
            p_ += 2;
            if (!authority()) return false;
            if (p_ < end_ && *p_ != '/' && *p_ != '?' && *p_ != '#') return false;
        } else if (!has_scheme) {
            const char* segment = p_;
            run("");
            if (std::find(segment, p_, ':') != p_) return false;
        }
        run("/");
        return true;
    }

    bool authority() {
        const char* begin = p_;
        run("");  // user@host:port; ':' and '@' are path characters too
        if (at('[')) {
            while (p_ < end_ && *p_ != ']') ++p_;
            if (!at(']')) return false;
            ++p_;
            if (at(':')) run("");
            return true;
        }
        std::string_view host(begin, size_t(p_ - begin));
        size_t user = host.rfind('@');
        if (user != host.npos) host.remove_prefix(user + 1);
        size_t colon = host.find(':');
        if (colon == host.npos) return true;
        std::string_view port = host.substr(colon + 1);
        for (char c : port)
            if (!is_digit(c)) return false;
        return !port.empty();
    }

    // Characters of a path segment, and those given.
    void run(const char* more) {
        while (p_ < end_) {
            char c = *p_;
            bool escaped = c == '%' && end_ - p_ > 2 && is_hex(p_[1]) && is_hex(p_[2]);
            if (escaped) {
                p_ += 3;
                continue;
            }
            if (!kPathBytes[uint8_t(c)] && !(c && std::strchr(more, c))) return;
            ++p_;
        }
    }

    const char* p_;
    const char* end_;
};

// Digits from `at`, exactly n (or at least n with more); the value.
bool take(std::string_view& text, size_t n, int& value, bool more = false) {
    size_t count = 0;
    value = 0;
    while (count < text.size() && is_digit(text[count]) && (more || count < n))
        value = value * 10 % 100000000 + (text[count++] - '0');
    if (count < n) return false;
    text.remove_prefix(count);
    return true;
}

bool take(std::string_view& text, char c) {
    if (text.empty() || text[0] != c) return false;
    text.remove_prefix(1);
    return true;
}

int days_of(int year, int month) {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return kDays[month - 1] + (month == 2 && leap);
}

bool is_zone(std::string_view text) {
    if (text.empty() || text == "Z") return true;
    int hours, minutes;
    if (text[0] != '+' && text[0] != '-') return false;
    text.remove_prefix(1);
    if (!take(text, 2, hours) || !take(text, ':') || !take(text, 2, minutes)) return false;
    return text.empty() && minutes < 60 && hours * 60 + minutes <= 14 * 60;
}

}  // namespace

bool is_ncname(std::string_view word) {
    return is_name_of(word, false);
}

bool is_name(std::string_view word) {
    return is_name_of(word, true);
}

bool is_uri(std::string_view word) {
    return Uri(word).whole();
}

bool is_date_time(std::string_view text) {
    int year, month, day, hour, minute, second, ignored;
    if (!text.empty() && text[0] == '-') text.remove_prefix(1);
    bool padded = !text.empty() && text[0] == '0';
    size_t size = text.size();
    if (!take(text, 4, year, true) || year == 0 || (padded && size - text.size() > 4)) return false;
    if (!take(text, '-') || !take(text, 2, month) || !take(text, '-') || !take(text, 2, day))
        return false;
    if (!take(text, 'T') || !take(text, 2, hour) || !take(text, ':') || !take(text, 2, minute) ||
        !take(text, ':') || !take(text, 2, second))
        return false;
    bool fraction = take(text, '.');
    if (fraction && !take(text, 1, ignored, true)) return false;
    bool midnight = hour == 24 && minute == 0 && second == 0;
    return month >= 1 && month <= 12 && day >= 1 && day <= days_of(year, month) && minute < 60 &&
           second < 60 && (hour < 24 || midnight) && is_zone(text);
}

}  // namespace kinora::collada
