// collada/text/numbers.cpp: the numbers and words of a text, whatever the locale.
#include <fast_float/fast_float.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include "collada/text/number_reading_p.h"
#include "collada/text/number_run.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Of a number beyond a double's range: whether it is too small rather than too large.
bool below_one(std::string_view word) {
    word.remove_prefix(word.starts_with('-'));
    size_t e = std::min(word.find_first_of("eE"), word.size());
    int64_t power = 0;
    if (e + 1 < word.size()) {
        bool sign = word[e + 1] == '-' || word[e + 1] == '+';
        auto [stop, error] =
            std::from_chars(word.data() + e + 1 + sign, word.data() + word.size(), power);
        if (error != std::errc{}) power = std::numeric_limits<int32_t>::max();  // of either sign
        if (word[e + 1] == '-') power = -power;
    }
    word = word.substr(0, e);
    word.remove_prefix(std::min(word.find_first_not_of('0'), word.size()));
    size_t point = std::min(word.find('.'), word.size());
    if (point > 0) return int64_t(point) + power <= 0;
    size_t first = std::min(word.find_first_not_of('0', 1), word.size());
    return power - int64_t(first) < 0;
}

// A word that from_chars reads whole.
bool exact_double(std::string_view word, double& value) {
    if (word.starts_with("+-")) return false;
    word.remove_prefix(word.starts_with('+'));
    auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (stop != word.data() + word.size()) return false;
    if (error == std::errc::result_out_of_range) {
        value = (word.front() == '-' ? -1 : 1) * (below_one(word) ? 0 : kInfinity);
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

double slow_double(std::string_view word, size_t at, NumberFaults& faults) {
    auto note = [&](NumberFaults::Word& first) {
        if (first.length == 0) first = {at, word.size()};
    };
    double value = 0;
    if (exact_double(word, value) || windows_nan(word, value)) {
        if (!std::isfinite(value)) note(faults.nonfinite);
    } else if (comma_decimal(word, value)) {
        note(faults.comma);
    } else {
        note(faults.number);
        value = 0;
    }
    return value;
}

// Digits that do not fit are cut to the largest number, other nonsense is 0.
int32_t slow_int(std::string_view word, size_t at, NumberFaults& faults) {
    bool negative = word.starts_with('-');
    std::string_view digits = word.substr(negative || word.starts_with('+'));
    const int64_t most = std::numeric_limits<int32_t>::max() + int64_t(negative);
    int64_t value = 0;
    for (char c : digits) {
        if (c < '0' || c > '9') digits = {};
        if (digits.empty()) break;
        value = std::min(value * 10 + (c - '0'), most);
    }
    if (!digits.empty()) return int32_t(negative ? -value : value);
    if (faults.number.length == 0) faults.number = {at, word.size()};
    return 0;
}

// A finite number that is the whole word; false: it may be one all the same. Flattened, since a
// call of fast_float's reader costs a tenth of the time of long numbers.
[[gnu::flatten]] bool usual_double(const char* p, const char* stop, double& value) {
    auto [end, error] = fast_float::from_chars(p, stop, value);
    return end == stop && error == std::errc{} && std::isfinite(value);
}

const char* word_end(const char* p, const char* end) {
    while (p < end && !is_number_space(*p)) ++p;
    return p;
}

// A text, word by word. Near its end the rest is copied, so that scanning may look ahead.
struct Words {
    explicit Words(std::string_view text)
        : begin(text.data()), p(begin), end(begin + text.size()) {}
    Words(const Words&) = delete;

    // The next word is [p, stop); false at the end. Go on with p = stop.
    bool next() {
        while (p < end && is_number_space(*p)) ++p;
        if (p == end) return false;
        if (end - p < kScanReach) copy_tail();
        int run;
        stop = p;
        do stop += run = solid_run(stop);
        while (run == 16 && end - stop >= kScanReach);
        if (run == 16) stop = word_end(stop, end);
        return true;
    }
    void copy_tail() {
        if (begin == tail) return;
        size_t left = size_t(end - p);
        offset = size_t(p - begin);
        std::copy(p, end, tail);
        std::memset(tail + left, 0, sizeof tail - left);
        p = begin = tail;
        end = tail + left;
    }
    std::string_view word() const { return {p, size_t(stop - p)}; }
    size_t position() const { return offset + size_t(p - begin); }  // in the text

    const char *begin, *p, *end, *stop = nullptr;
    size_t offset = 0;  // of `begin` in the text
    char tail[2 * kScanReach];
};

const char* read_short(const char* begin, const char* p, const char* end, double*& out) {
    return read_short_doubles(begin, p, end, out);
}
const char* read_short(const char*, const char* p, const char* end, int32_t*& out) {
    return read_short_ints(p, end, out);
}

// Short words are read a piece of the text at a time, then one word of any form.
template <class T, bool (*Scan)(const char*, const char*, T&),
          T (*Slow)(std::string_view, size_t, NumberFaults&)>
std::vector<T> scan_list(std::string_view text, size_t expected, NumberFaults& faults) {
    constexpr std::ptrdiff_t kPiece = 1024;  // bytes; a number and its space are two at least
    T piece[kPiece / 2 + 1];
    std::vector<T> values;
    values.reserve(expected ? std::min(expected, text.size() / 2 + 1) : count_words(text));
    Words words(text);
    while (true) {
        T* out = piece;
        const char* end = words.p + std::min(words.end - words.p, kPiece + kScanReach);
        words.p = read_short(words.begin, words.p, end, out);
        values.insert(values.end(), piece, out);
        if (!words.next()) break;
        T value = 0;
        if (!Scan(words.p, words.stop, value)) value = Slow(words.word(), words.position(), faults);
        values.push_back(value);
        words.p = words.stop;
    }
    return values;
}

// Digits, or a sign or point before them.
bool begins_number(const char* p, const char* end) {
    auto is_digit = [&](const char* at) { return at < end && *at >= '0' && *at <= '9'; };
    if (p < end && (*p == '-' || *p == '+')) ++p;
    return is_digit(p) || (p < end && *p == '.' && is_digit(p + 1));
}

// A number of any form that a run has; null: the run ends here.
const char* scan_word(const char* p, const char* end, float& value) {
    double number = 0;
    const char* stop = scan_number(p, end, number);
    value = float(number);
    return stop && std::isfinite(number) ? stop : nullptr;
}
const char* scan_word(const char* p, const char* end, int32_t& value) {
    if (!begins_number(p, end)) return nullptr;
    auto [stop, error] = std::from_chars(p + (*p == '+'), end, value);
    bool longer = stop < end && (*stop == '.' || *stop == 'e' || *stop == 'E');
    return error == std::errc{} && !longer ? stop : nullptr;
}

// As scan_list(), where what is no number ends the list.
template <class T, class Short>
const char* append_run(const char* begin, const char* p, const char* end, std::vector<T>& values) {
    constexpr std::ptrdiff_t kPiece = 1024;
    Short piece[(kPiece + kScanReach) / 2 + 1];
    while (true) {
        Short* out = piece;
        p = std::min(read_short(begin, p, p + std::min(end - p, kPiece + kScanReach), out), end);
        values.insert(values.end(), piece, out);
        if (out - piece > kPiece / 32) continue;  // most of the piece
        while (p < end && is_number_space(*p)) ++p;
        T value;
        const char* stop = scan_word(p, end, value);
        if (!stop) return p;
        values.push_back(value);
        p = stop;
    }
}

}  // namespace

const char* append_floats(const char* begin, const char* p, const char* end,
                          std::vector<float>& values) {
    return append_run<float, double>(begin, p, end, values);
}

const char* append_ints(const char* begin, const char* p, const char* end,
                        std::vector<int32_t>& values) {
    return append_run<int32_t, int32_t>(begin, p, end, values);
}

const char* scan_number(const char* p, const char* end, double& value) {
    if (!begins_number(p, end)) return nullptr;
    p += *p == '+';
    auto [stop, error] = fast_float::from_chars(p, end, value);
    if (stop == p) return nullptr;
    if (error != std::errc{}) exact_double({p, size_t(stop - p)}, value);
    return stop;
}

bool comma_decimal(std::string_view word, double& value) {
    size_t comma = word.find(',');
    if (comma == word.npos || comma + 1 == word.size() || word.find(',', comma + 1) != word.npos ||
        word.find('.') != word.npos)
        return false;
    std::string point(word);
    point[comma] = '.';
    return exact_double(point, value);
}

size_t count_words(std::string_view text) {
    size_t words = 0, i = 0;
    bool inside = false;
#ifdef __SSE2__
    // A word begins where a byte above ' ' stands behind one that is not.
    auto solid = [&](size_t at) {
        auto* p = reinterpret_cast<const __m128i*>(text.data() + at);
        return _mm_xor_si128(_mm_loadu_si128(p), _mm_set1_epi8(-128));  // ordered as if signed
    };
    const __m128i space = _mm_set1_epi8(char(' ' ^ 0x80)), one = _mm_set1_epi8(1);
    for (i = 1; i + 16 <= text.size(); i += 16) {
        __m128i begins =
            _mm_andnot_si128(_mm_cmpgt_epi8(solid(i - 1), space), _mm_cmpgt_epi8(solid(i), space));
        __m128i sums = _mm_sad_epu8(_mm_and_si128(begins, one), _mm_setzero_si128());
        words += size_t(_mm_cvtsi128_si64(sums) + _mm_cvtsi128_si64(_mm_srli_si128(sums, 8)));
    }
    i = std::min(i, text.size());
    if (i > 0) {
        words += uint8_t(text[0]) > ' ';
        inside = uint8_t(text[i - 1]) > ' ';
    }
#endif
    for (; i < text.size(); ++i) {
        bool solid_byte = uint8_t(text[i]) > ' ';
        words += solid_byte && !inside;
        inside = solid_byte;
    }
    return words;
}

std::vector<double> scan_doubles(std::string_view text, size_t expected, NumberFaults& faults) {
    return scan_list<double, usual_double, slow_double>(text, expected, faults);
}

std::vector<int32_t> scan_ints(std::string_view text, size_t expected, NumberFaults& faults) {
    return scan_list<int32_t, scan_int, slow_int>(text, expected, faults);
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_number_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_number_space(text.back())) text.remove_suffix(1);
    return text;
}

bool parse_double(std::string_view text, double& value) {
    text = trim(text);
    return !text.empty() && exact_double(text, value) && std::isfinite(value);
}

std::optional<bool> parse_bool(std::string_view text) {
    text = trim(text);
    if (text == "true" || text == "TRUE" || text == "1") return true;
    if (text == "false" || text == "FALSE" || text == "0") return false;
    return std::nullopt;
}

bool parse_count(std::string_view text, uint64_t& value) {
    text = trim(text);
    auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && !text.empty() && stop == text.data() + text.size();
}

std::string_view word_number(std::string_view text, size_t number) {
    const char *p = text.data(), *end = p + text.size();
    while (true) {
        while (p < end && is_number_space(*p)) ++p;
        const char* stop = word_end(p, end);
        if (p == end || number-- == 0) return {p, size_t(stop - p)};
        p = stop;
    }
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    words.reserve(count_words(text));
    const char* end = text.data() + text.size();
    for (const char* p = text.data(); p < end;) {
        const char* stop = word_end(p, end);
        if (stop > p) words.emplace_back(p, size_t(stop - p));
        p = stop < end ? stop + 1 : end;
    }
    return words;
}

}  // namespace kinora::collada
