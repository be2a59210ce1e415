// collada/text/number_scan.cpp: is a text a list of numbers as XML Schema writes them? 64 bytes at
// a time become bit masks of digits, points, signs and white space, and rules of which may follow
// which are a few operations on those. What they do not accept a table decides, one look-up a byte:
// four parts of the text at once, since each waits for its last look-up.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "collada/text/words_p.h"

namespace kinora::collada {

namespace {

using Table = std::array<std::array<uint8_t, 256>, 32>;

constexpr uint8_t kSpace = 0, kBad = 31;

constexpr Table bad_table() {
    Table t{};
    for (auto& row : t) row.fill(kBad);
    for (char c : {' ', '\t', '\n', '\r'}) t[kSpace][uint8_t(c)] = kSpace;
    return t;
}

constexpr void digits(Table& t, uint8_t from, uint8_t to) {
    for (char c = '0'; c <= '9'; ++c) t[from][uint8_t(c)] = to;
}

constexpr void ends(Table& t, uint8_t state) {
    for (char c : {' ', '\t', '\n', '\r'}) t[state][uint8_t(c)] = kSpace;
}

constexpr Table real_table() {
    enum : uint8_t {
        Minus = 1,
        Plus,
        Int,
        Point,
        BarePoint,
        Fraction,
        E,
        ESign,
        Exponent,
        I,
        In,
        Inf,
        N,
        Na,
        Nan
    };
    Table t = bad_table();
    for (uint8_t s : {uint8_t(kSpace), uint8_t(Minus), uint8_t(Plus)})
        digits(t, s, Int), t[s]['.'] = BarePoint;
    t[kSpace]['-'] = Minus;
    t[kSpace]['+'] = Plus;
    digits(t, Int, Int);
    t[Int]['.'] = Point;
    digits(t, Point, Fraction);
    digits(t, BarePoint, Fraction);
    digits(t, Fraction, Fraction);
    for (uint8_t s : {Int, Point, Fraction}) t[s]['e'] = t[s]['E'] = E;
    t[E]['+'] = t[E]['-'] = ESign;
    digits(t, E, Exponent);
    digits(t, ESign, Exponent);
    digits(t, Exponent, Exponent);
    t[kSpace]['I'] = t[Minus]['I'] = I;  // XML Schema 1.0 has no "+INF"
    t[I]['N'] = In;
    t[In]['F'] = Inf;
    t[kSpace]['N'] = N;
    t[N]['a'] = Na;
    t[Na]['N'] = Nan;
    for (uint8_t s : {Int, Point, Fraction, Exponent, Inf, Nan}) ends(t, s);
    return t;
}

constexpr Table whole_table(bool signs) {
    constexpr uint8_t kSign = 1, kFirst = 2, kLast = kFirst + 17;
    Table t = bad_table();
    if (signs) t[kSpace]['+'] = t[kSpace]['-'] = kSign;
    digits(t, kSpace, kFirst);
    digits(t, kSign, kFirst);
    for (uint8_t s = kFirst; s <= kLast; ++s) {
        if (s < kLast) digits(t, s, uint8_t(s + 1));
        ends(t, s);
    }
    return t;
}

constexpr Table kReal = real_table(), kWhole = whole_table(true), kNatural = whole_table(false);

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

bool run(const Table& t, std::string_view text) {
    constexpr size_t kParts = 4, kWorth = 256;
    size_t from[kParts + 1] = {};
    for (size_t k = 1; k <= kParts; ++k) {
        size_t at = std::max(text.size() / kParts * k, from[k - 1]);
        if (text.size() < kWorth || k == kParts) at = text.size();
        while (at < text.size() && !is_space(text[at])) ++at;
        from[k] = at;
    }
    uint8_t state[kParts] = {};
    size_t shortest = text.size();
    for (size_t k = 0; k < kParts; ++k) shortest = std::min(shortest, from[k + 1] - from[k]);
    const char* p = text.data();
    for (size_t i = 0; i < shortest; ++i)
        for (size_t k = 0; k < kParts; ++k) state[k] = t[state[k]][uint8_t(p[from[k] + i])];
    for (size_t k = 0; k < kParts; ++k) {
        for (size_t i = from[k] + shortest; i < from[k + 1]; ++i)
            state[k] = t[state[k]][uint8_t(p[i])];
        if (t[state[k]][' '] == kBad) return false;
    }
    return true;
}

#ifdef __SSE2__

// A bit for each of 64 bytes.
struct Masks {
    uint64_t digit, point, sign, e, space;
};

// Which bytes of 16 are what; `reals`: points and e's are looked for.
template <bool reals>
[[gnu::always_inline]] inline void classify(__m128i b, int shift, Masks& m) {
    auto is = [&](char c) { return _mm_cmpeq_epi8(b, _mm_set1_epi8(c)); };
    auto add = [&](uint64_t& mask, __m128i bytes) {
        mask |= uint64_t(uint32_t(_mm_movemask_epi8(bytes))) << shift;
    };
    __m128i value = _mm_sub_epi8(b, _mm_set1_epi8('0'));
    add(m.digit, _mm_cmpeq_epi8(_mm_min_epu8(value, _mm_set1_epi8(9)), value));
    add(m.sign, _mm_or_si128(is('+'), is('-')));
    add(m.space, _mm_or_si128(_mm_or_si128(is(' '), is('\n')), _mm_or_si128(is('\t'), is('\r'))));
    if constexpr (!reals) return;
    add(m.point, is('.'));
    add(m.e, _mm_cmpeq_epi8(_mm_or_si128(b, _mm_set1_epi8(32)), _mm_set1_epi8('e')));
}

template <bool reals>
[[gnu::always_inline]] inline Masks masks_of(const char* p) {
    Masks m{};
    for (int k = 0; k < 4; ++k)
        classify<reals>(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p) + k), 16 * k, m);
    return m;
}

// The masks moved up by one byte: of each byte what stands before it. Before a text stands a space.
[[gnu::always_inline]] inline Masks before(const Masks& m, const Masks& last) {
    auto up = [](uint64_t now, uint64_t then) { return now << 1 | then >> 63; };
    return {up(m.digit, last.digit), up(m.point, last.point), up(m.sign, last.sign),
            up(m.e, last.e), up(m.space, last.space)};
}

// From each of `from` to the next of `marks` behind it; `open` says that one of the block before
// has not met its mark yet. A carry runs through what is no mark.
uint64_t next_mark(uint64_t from, uint64_t marks, bool& open) {
    uint64_t sum;
    bool carry = __builtin_add_overflow(from << 1 | uint64_t(open), ~marks, &sum);
    open = carry || from >> 63;
    return sum & marks;
}

class RealRules {
  public:
    // The rules of real_table() without INF and NaN.
    bool holds(const char* p) {
        const Masks m = masks_of<true>(p), b = before(m, last_);
        uint64_t digit_twice_before = b.digit << 1 | last_before_.digit >> 63;
        uint64_t e_twice_before = b.e << 1 | last_before_.e >> 63;
        uint64_t ended = b.digit | (b.point & digit_twice_before);  // a mantissa, before this byte
        uint64_t marks = m.point | m.e | m.space;
        uint64_t bad = ~(m.digit | m.sign | marks);
        bad |= m.sign & ~(b.space | b.e);
        bad |= m.point & ~(b.space | b.digit | (b.sign & ~e_twice_before));
        bad |= m.e & ~ended;
        bad |= m.space & ~(b.space | ended);
        bad |= next_mark(m.point, marks, after_point_) & m.point;
        bad |= next_mark(m.e, marks, after_e_) & (m.point | m.e);
        last_ = m;
        last_before_ = b;
        return bad == 0;
    }

  private:
    Masks last_{0, 0, 0, 0, ~uint64_t(0)}, last_before_{0, 0, 0, 0, ~uint64_t(0)};
    bool after_point_ = false, after_e_ = false;
};

template <bool signs>
class WholeRules {
  public:
    bool holds(const char* p) {
        const Masks m = masks_of<false>(p), b = before(m, last_);
        uint64_t bad = ~(m.digit | m.space | (signs ? m.sign : 0));
        bad |= m.sign & ~b.space;
        bad |= m.space & b.sign;
        // 19 digits in a row fill one of the aligned groups of eight: the table counts them.
        uint64_t others = ~m.digit;
        bad |= (others - 0x0101010101010101u) & m.digit & 0x8080808080808080u;
        last_ = m;
        return bad == 0;
    }

  private:
    Masks last_{0, 0, 0, 0, ~uint64_t(0)};
};

// False may be wrong.
template <class Rules>
bool holds_for_all(std::string_view text) {
    Rules rules;
    const char *p = text.data(), *end = p + text.size();
    for (; end - p >= 64; p += 64)
        if (!rules.holds(p)) return false;
    char rest[64];  // with a space at least, so that the last number ends
    std::memset(rest, ' ', sizeof rest);
    std::copy(p, end, rest);
    return rules.holds(rest);
}

bool regular_reals(std::string_view text) {
    return holds_for_all<RealRules>(text);
}
bool regular_wholes(std::string_view text, bool signs) {
    return signs ? holds_for_all<WholeRules<true>>(text) : holds_for_all<WholeRules<false>>(text);
}

#else

bool regular_reals(std::string_view) {
    return false;
}
bool regular_wholes(std::string_view, bool) {
    return false;
}

#endif

}  // namespace

bool is_real_list(std::string_view text) {
    return regular_reals(text) || run(kReal, text);
}

bool is_whole_list(std::string_view text, bool signs) {
    return regular_wholes(text, signs) || run(signs ? kWhole : kNatural, text);
}

bool is_real_list_by_table(std::string_view text) {
    return run(kReal, text);
}

bool is_whole_list_by_table(std::string_view text, bool signs) {
    return run(signs ? kWhole : kNatural, text);
}

}  // namespace kinora::collada
