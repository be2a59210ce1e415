// collada/numbers.cpp: the numbers of an element's text, whatever the locale.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "collada/findings.h"
#include "collada/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Clinger's fast path: a mantissa below 2^53 and a power of ten that is exact give the correctly
// rounded double with one operation. False: not of that form.
bool fast_double(const char*& p, const char* end, double& value) {
    const char* c = p;
    bool negative = c < end && *c == '-';
    if (negative) ++c;
    uint64_t mantissa = 0;
    int digits = 0, exponent = 0;
    const char* first = c;
    for (; c < end && is_digit(*c); ++c, ++digits) mantissa = mantissa * 10 + uint64_t(*c - '0');
    if (c == first) return false;
    if (c < end && *c == '.') {
        const char* point = ++c;
        for (; c < end && is_digit(*c); ++c, ++digits)
            mantissa = mantissa * 10 + uint64_t(*c - '0');
        exponent = -int(c - point);
    }
    if (digits > 18 || mantissa > (uint64_t(1) << 53)) return false;
    if (c < end && (*c == 'e' || *c == 'E')) {
        int e = 0;
        const char* at = c + 1;
        if (at < end && *at == '+') ++at;
        auto [stop, error] = std::from_chars(at, end, e);
        if (error != std::errc{} || std::abs(e) > 1000) return false;
        exponent += e;
        c = stop;
    }
    if (exponent < -22 || exponent > 22 || (c < end && !is_space(*c))) return false;
    double m = double(mantissa);
    value = exponent < 0 ? m / kPowersOfTen[-exponent] : m * kPowersOfTen[exponent];
    if (negative) value = -value;
    p = c;
    return true;
}

// A word that from_chars reads whole.
bool exact_double(std::string_view word, double& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (stop != word.data() + word.size()) return false;
    if (error == std::errc::result_out_of_range) {
        bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
        value = (word.front() == '-' ? -1 : 1) * (tiny ? 0 : kInfinity);
        return true;
    }
    return error == std::errc{};
}

// What Microsoft's C library prints for numbers that are none.
bool windows_nan(std::string_view word, double& value) {
    bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    if (!word.starts_with("1.#")) return false;
    value = word.starts_with("1.#INF") ? kInfinity : kNan;
    if (negative) value = -value;
    return true;
}

// "1,5" under a comma locale; not "1,2,3".
bool comma_decimal(std::string_view word, double& value) {
    size_t comma = word.find(',');
    if (comma == word.npos || comma + 1 == word.size() || word.find(',', comma + 1) != word.npos ||
        word.find('.') != word.npos)
        return false;
    std::string point(word);
    point[comma] = '.';
    return exact_double(point, value);
}

// The first trouble of each kind in one text.
struct Trouble {
    std::string_view number, comma, nonfinite;
};

double slow_double(std::string_view word, Trouble& trouble) {
    double value = 0;
    if (exact_double(word, value) || windows_nan(word, value)) {
        if (!std::isfinite(value) && trouble.nonfinite.empty()) trouble.nonfinite = word;
        return value;
    }
    if (comma_decimal(word, value)) {
        if (trouble.comma.empty()) trouble.comma = word;
        return value;
    }
    if (trouble.number.empty()) trouble.number = word;
    return 0;
}

void report(const Trouble& trouble, const Document& document, const Element& element,
            Diagnostics& diag) {
    auto say = [&](const FindingInfo& code, std::string_view word) {
        if (word.empty()) return;
        size_t begin = size_t(word.data() - element.text.data());
        diag.report(code, document.text_location(element, begin, begin + word.size()), word);
    };
    say(Code::SRC_NUMBER, trouble.number);
    say(Code::SRC_COMMA_DECIMAL, trouble.comma);
    say(Code::SRC_NAN_INF, trouble.nonfinite);
}

std::string_view word_at(const char* p, const char* end) {
    const char* stop = p;
    while (stop < end && !is_space(*stop)) ++stop;
    return {p, size_t(stop - p)};
}

template <class T>
std::vector<T> read_reals(const Document& document, const Element& element, Diagnostics& diag) {
    std::vector<T> values;
    // A guess that fits usual lists; a list of single digits grows once or twice.
    values.reserve(element.text.size() / 8 + 4);
    Trouble trouble;
    const char* p = element.text.data();
    const char* end = p + element.text.size();
    while (true) {
        while (p < end && is_space(*p)) ++p;
        if (p == end) break;
        double value = 0;
        if (!fast_double(p, end, value)) {
            std::string_view word = word_at(p, end);
            value = slow_double(word, trouble);
            p = word.data() + word.size();
        }
        values.push_back(T(value));
    }
    report(trouble, document, element, diag);
    return values;
}

}  // namespace

std::vector<double> read_doubles(const Document& document, const Element& element,
                                 Diagnostics& diag) {
    return read_reals<double>(document, element, diag);
}

std::vector<float> read_floats(const Document& document, const Element& element,
                               Diagnostics& diag) {
    return read_reals<float>(document, element, diag);
}

std::vector<int32_t> read_ints(const Document& document, const Element& element,
                               Diagnostics& diag) {
    std::vector<int32_t> values;
    values.reserve(element.text.size() / 4 + 4);
    Trouble trouble;
    const char* p = element.text.data();
    const char* end = p + element.text.size();
    while (true) {
        while (p < end && is_space(*p)) ++p;
        if (p == end) break;
        const char* first = p;
        bool negative = *p == '-';
        if (negative || *p == '+') ++p;
        const char* digits = p;
        int64_t value = 0;
        for (; p < end && is_digit(*p); ++p)
            value = std::min<int64_t>(value * 10 + (*p - '0'), std::numeric_limits<int32_t>::max());
        if (p == digits || (p < end && !is_space(*p))) {
            std::string_view word = word_at(first, end);
            if (trouble.number.empty()) trouble.number = word;
            p = word.data() + word.size();
            value = 0;
        }
        values.push_back(int32_t(negative ? -value : value));
    }
    report(trouble, document, element, diag);
    return values;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

bool parse_double(std::string_view text, double& value) {
    text = trim(text);
    return !text.empty() && exact_double(text, value) && std::isfinite(value);
}

bool parse_count(std::string_view text, uint64_t& value) {
    text = trim(text);
    auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && !text.empty() && stop == text.data() + text.size();
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    const char* end = text.data() + text.size();
    for (const char* p = text.data(); p < end;) {
        if (is_space(*p)) {
            ++p;
            continue;
        }
        words.push_back(word_at(p, end));
        p += words.back().size();
    }
    return words;
}

}  // namespace kinora::collada
