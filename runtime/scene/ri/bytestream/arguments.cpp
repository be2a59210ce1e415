// runtime/scene/ri/bytestream/arguments.cpp: the arguments of a request, by its row in
// requests.def, in all forms that RIB has for them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "runtime/scene/ri/bytestream/basis_names_p.h"
#include "runtime/scene/ri/bytestream/request_reader_p.h"

namespace kinora::ri {
namespace {

constexpr std::string_view kNumberLetters = "ifmbc";

bool is_number_letter(char letter) {
    return kNumberLetters.find(letter) != std::string_view::npos;
}

size_t numbers_of(char letter, uint32_t color_samples) {
    switch (letter) {
        case 'm':
            return 16;
        case 'b':
            return 6;
        case 'c':
            return color_samples;
        default:
            return 1;
    }
}

// Numbers that files leave out at the end of a request.
struct AssumedRow {
    Request request;
    double last;
};
constexpr AssumedRow kAssumed[] = {{Request::Format, -1}};

struct ArrayRow {
    char letter;
    Values::Kind kind;
};
constexpr ArrayRow kArrays[] = {
    {'I', Values::Kind::Integers}, {'F', Values::Kind::Floats}, {'S', Values::Kind::Strings}};

constexpr std::string_view kNotClosed = "an array is not closed";

}  // namespace

// Where the request ends too early, it has the place.
Outcome RequestReader::argument_error(const Token& at, std::string_view what) {
    bool ended = at.kind == TokenKind::Word || at.kind == TokenKind::End;
    const Token& place = ended ? word_ : at;
    report_.add(Code::RIB_ARGUMENT, place, name(), what, Report::byte(place));
    return Outcome::LeftOut;
}

// A token that is wrong says why itself.
Outcome RequestReader::syntax_error(const Token& at, std::string_view what) {
    bool bad = at.kind == TokenKind::Bad;
    report_.add(bad && at.encoded ? Code::RIB_CODE : Code::RIB_SYNTAX, at, bad ? at.text : what,
                Report::byte(at));
    return Outcome::Broken;
}

Outcome RequestReader::read_arguments(std::string_view letters) {
    for (size_t i = 0; i < letters.size() && letters[i] != '*';) {
        if (letters[i] == '?') {
            if (!more_arguments()) break;
            ++i;
            continue;
        }
        size_t stop = i;
        while (stop < letters.size() && is_number_letter(letters[stop])) ++stop;
        bool last = i + 1 == letters.size() || letters[i + 1] == '*';
        Outcome outcome =
            stop > i ? read_group(letters.substr(i, stop - i)) : read_argument(letters[i], last);
        if (outcome != Outcome::Read) return outcome;
        i = std::max(stop, i + 1);
    }
    return Outcome::Read;
}

// Whether what comes next is an argument rather than a parameter or the next request.
bool RequestReader::more_arguments() {
    TokenKind kind = lexer_.peek().kind;
    return kind == TokenKind::Number || kind == TokenKind::Open || kind == TokenKind::Floats;
}

Outcome RequestReader::read_argument(char letter, bool last) {
    if (letter == 's') return read_string();
    if (letter == 'h') return read_handle();
    if (letter == 'x') return read_basis();
    auto row = std::ranges::find(kArrays, letter, &ArrayRow::letter);
    return read_values(row->kind, last, arguments_.emplace_back());
}

// Numbers that C takes one by one.
Outcome RequestReader::read_group(std::string_view letters) {
    size_t wanted = 0;
    for (char letter : letters) wanted += numbers_of(letter, context_.count_state().color_samples);
    group_.clear();
    if (Outcome outcome = collect_numbers(wanted); outcome != Outcome::Read) return outcome;
    for (const AssumedRow& row : kAssumed)
        if (row.request == request_ && group_.size() + 1 == wanted) group_.push_back(row.last);
    if (group_.size() < wanted)
        return argument_error(
            lexer_.peek().kind == TokenKind::End ? word_ : lexer_.peek(),
            fmt::format("{} numbers are wanted, and {} are here", wanted, group_.size()));
    if (group_.size() > wanted)
        argument_error(word_, fmt::format("{} numbers are wanted; the last {} are left out", wanted,
                                          group_.size() - wanted));
    store_group(letters);
    return Outcome::Read;
}

Outcome RequestReader::collect_numbers(size_t wanted) {
    while (group_.size() < wanted && more_arguments()) {
        Token token = lexer_.take();
        if (token.kind == TokenKind::Number) {
            group_.push_back(token.number);
            continue;
        }
        std::vector<float> floats;
        if (token.kind == TokenKind::Floats) push_all(floats, token);
        group_.insert(group_.end(), floats.begin(), floats.end());
        if (token.kind == TokenKind::Floats) continue;
        while (lexer_.peek().kind == TokenKind::Number) group_.push_back(lexer_.take().number);
        if (lexer_.peek().kind != TokenKind::Close) return syntax_error(lexer_.peek(), kNotClosed);
        lexer_.take();
    }
    return Outcome::Read;
}

void RequestReader::store_group(std::string_view letters) {
    fraction_ = false;
    const double* number = group_.data();
    for (char letter : letters) {
        if (letter == 'i') {
            arguments_.push_back({Values::Kind::Integers, false, integers_.size(), 1});
            integers_.push_back(whole(*number++));
            continue;
        }
        size_t count = numbers_of(letter, context_.count_state().color_samples);
        arguments_.push_back({Values::Kind::Floats, letter != 'f', floats_.size(), count});
        for (size_t i = 0; i < count; ++i) floats_.push_back(float(*number++));
    }
    if (fraction_) argument_error(word_, "a whole number is wanted; the fraction is dropped");
}

int RequestReader::whole(double value) {
    if (!(value == std::trunc(value))) fraction_ = true;
    if (std::isnan(value)) return 0;
    constexpr double kLeast = std::numeric_limits<int>::min(),
                     kMost = std::numeric_limits<int>::max();
    return int(std::clamp(value, kLeast, kMost));
}

Outcome RequestReader::read_string() {
    Token first = lexer_.peek();
    Piece piece;
    Outcome outcome = read_values(Values::Kind::Strings, false, piece);
    if (outcome != Outcome::Read) return outcome;
    if (piece.count != 1) return argument_error(first, "one string is wanted");
    piece.array = false;
    arguments_.push_back(piece);
    return Outcome::Read;
}

// As a string, so that 7 and "7" are one.
Outcome RequestReader::read_handle() {
    bool bracket = lexer_.peek().kind == TokenKind::Open;
    if (bracket) lexer_.take();
    Token token = lexer_.peek();
    if (token.kind == TokenKind::Number)
        strings_.push_back(lexer_.keep(fmt::format("{}", whole(token.number))).data());
    else if (token.kind == TokenKind::String)
        strings_.push_back(token.text.data());
    else
        return argument_error(token, "a handle is wanted: a number or a string");
    lexer_.take();
    if (bracket && lexer_.peek().kind != TokenKind::Close)
        return syntax_error(lexer_.peek(), kNotClosed);
    if (bracket) lexer_.take();
    arguments_.push_back({Values::Kind::Strings, false, strings_.size() - 1, 1});
    return Outcome::Read;
}

Outcome RequestReader::read_basis() {
    Token token = lexer_.peek();
    if (token.kind != TokenKind::String) return read_group("m");
    lexer_.take();
    const float* basis = basis_named(token.text);
    if (!basis)
        return argument_error(token, fmt::format("no basis is called '{}'", shown(token.text)));
    arguments_.push_back({Values::Kind::Floats, true, floats_.size(), 16});
    floats_.insert(floats_.end(), basis, basis + 16);
    return Outcome::Read;
}

void RequestReader::push(std::vector<float>& values, const Token& number) {
    if (!std::isfinite(number.number) && !std::exchange(non_finite_told_, true))
        report_.add(Code::RIB_NUMBER, number, Report::byte(number));
    values.push_back(float(number.number));
}

void RequestReader::push(std::vector<int>& values, const Token& number) {
    values.push_back(whole(number.number));
}

template <class T>
void RequestReader::push_all(std::vector<T>& values, const Token& floats) {
    size_t count = floats.text.size() / 4, first = values.size();
    values.resize(first + count);
    const char* p = floats.text.data();
    for (size_t i = 0; i < count; ++i, p += 4) {
        uint32_t bits;
        std::memcpy(&bits, p, 4);
        if constexpr (std::endian::native == std::endian::little) bits = __builtin_bswap32(bits);
        float value = std::bit_cast<float>(bits);
        if constexpr (std::is_same_v<T, int>)
            values[first + i] = whole(double(value));
        else
            values[first + i] = value;
    }
}

// One of an array, or its end (LeftOut).
template <class T>
Outcome RequestReader::read_element(std::vector<T>& values) {
    lexer_.take_numbers(values);
    switch (lexer_.peek().kind) {
        case TokenKind::Number:
            push(values, lexer_.take());
            return Outcome::Read;
        case TokenKind::Floats:
            push_all(values, lexer_.take());
            return Outcome::Read;
        case TokenKind::Close:
            lexer_.take();
            return Outcome::LeftOut;
        case TokenKind::String:
            lexer_.take();
            wrong_kind_ = true;
            return Outcome::Read;
        case TokenKind::End:
        case TokenKind::Word:
        case TokenKind::Open:
        case TokenKind::Bad:
            break;
    }
    return syntax_error(lexer_.peek(), kNotClosed);
}

Outcome RequestReader::read_element(std::vector<const char*>& values) {
    Token token = lexer_.peek();
    switch (token.kind) {
        case TokenKind::String:
            values.push_back(token.text.data());
            break;
        case TokenKind::Number:
        case TokenKind::Floats:
            wrong_kind_ = true;
            break;
        case TokenKind::Close:
            lexer_.take();
            return Outcome::LeftOut;
        case TokenKind::End:
        case TokenKind::Word:
        case TokenKind::Open:
        case TokenKind::Bad:
            return syntax_error(token, kNotClosed);
    }
    lexer_.take();
    return Outcome::Read;
}

template <class T>
Outcome RequestReader::read_numbers(std::vector<T>& values, bool several) {
    Token first = lexer_.take();
    if (first.kind == TokenKind::Number) push(values, first);
    if (first.kind == TokenKind::Floats) push_all(values, first);
    if (first.kind == TokenKind::String) wrong_kind_ = true;
    while (first.kind == TokenKind::Number && several && lexer_.peek().kind == TokenKind::Number)
        push(values, lexer_.take());
    Outcome outcome = first.kind == TokenKind::Open ? Outcome::Read : Outcome::LeftOut;
    while (outcome == Outcome::Read) outcome = read_element(values);
    return outcome == Outcome::Broken ? outcome : Outcome::Read;
}

Outcome RequestReader::read_strings() {
    Token first = lexer_.take();
    if (first.kind == TokenKind::String) strings_.push_back(first.text.data());
    // An array of no numbers is one of no strings.
    bool floats = first.kind == TokenKind::Floats && !first.text.empty();
    if (first.kind == TokenKind::Number || floats) wrong_kind_ = true;
    Outcome outcome = first.kind == TokenKind::Open ? Outcome::Read : Outcome::LeftOut;
    while (outcome == Outcome::Read) outcome = read_element(strings_);
    return outcome == Outcome::Broken ? outcome : Outcome::Read;
}

Outcome RequestReader::read_values(Values::Kind kind, bool several, Piece& piece) {
    Token first = lexer_.peek();
    bool strings = kind == Values::Kind::Strings, integers = kind == Values::Kind::Integers;
    std::string_view wanted = strings    ? "strings are"
                              : integers ? "whole numbers are"
                                         : "numbers are";
    if (first.kind == TokenKind::Bad || first.kind == TokenKind::Close)
        return syntax_error(first, "a bracket closes nothing");
    if (first.kind == TokenKind::Word || first.kind == TokenKind::End)
        return argument_error(first, fmt::format("{} wanted, and the request ends", wanted));
    auto size = [&] {
        return strings ? strings_.size() : integers ? integers_.size() : floats_.size();
    };
    wrong_kind_ = fraction_ = false;
    Piece read{kind, true, size(), 0};
    Outcome outcome = strings    ? read_strings()
                      : integers ? read_numbers(integers_, several)
                                 : read_numbers(floats_, several);
    if (outcome != Outcome::Read) return outcome;
    read.count = size() - read.begin;
    piece = read;
    if (fraction_) argument_error(first, "whole numbers are wanted; fractions are dropped");
    if (wrong_kind_) return argument_error(first, fmt::format("{} wanted", wanted));
    return Outcome::Read;
}

Outcome RequestReader::skip_value() {
    Token token = lexer_.take();
    if (token.kind != TokenKind::Open) return Outcome::Read;
    while (true) {
        token = lexer_.peek();
        if (token.kind == TokenKind::Word || token.kind == TokenKind::End ||
            token.kind == TokenKind::Open || token.kind == TokenKind::Bad)
            return syntax_error(token, kNotClosed);
        lexer_.take();
        if (token.kind == TokenKind::Close) return Outcome::Read;
    }
}

}  // namespace kinora::ri
