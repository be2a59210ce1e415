// collada/number_scan.cpp: is a text a list of numbers as XML Schema writes them? One table look-up
// a byte; four parts of the text at once, since each waits for its last look-up.
#include <algorithm>
#include <array>
#include <cstdint>

#include "collada/simple_types_p.h"

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
        Sign = 1,
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
    for (uint8_t s : {uint8_t(kSpace), uint8_t(Sign)}) digits(t, s, Int), t[s]['.'] = BarePoint;
    t[kSpace]['+'] = t[kSpace]['-'] = Sign;
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
    t[kSpace]['I'] = t[Sign]['I'] = I;  // "+INF" is let through here and refused by is_real
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

}  // namespace

bool is_real_list(std::string_view text) {
    return run(kReal, text);
}

bool is_whole_list(std::string_view text, bool signs) {
    return run(signs ? kWhole : kNatural, text);
}

}  // namespace kinora::collada
