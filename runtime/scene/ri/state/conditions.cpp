// runtime/scene/ri/state/conditions.cpp: the expressions of IfBegin and ElseIf, computed while they
// are read.
#include "runtime/scene/ri/state/conditions.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <span>

#include "runtime/base/numbers.h"

namespace kinora::ri {
namespace {

constexpr int kDeepest = 200;  // brackets within each other

ConditionValue truth(bool value) {
    return {std::nullopt, value ? 1.0 : 0.0};
}

bool equal(const ConditionValue& a, const ConditionValue& b) {
    if (a.text && b.text) return *a.text == *b.text;
    return !a.text && !b.text && a.number == b.number;
}

// Texts by their letters; a text and a number have no order.
std::optional<double> difference(const ConditionValue& a, const ConditionValue& b) {
    if (a.text && b.text) return a.text->compare(*b.text);
    if (a.text || b.text) return std::nullopt;
    return a.number - b.number;
}

template <class Holds>
ConditionValue ordered(const ConditionValue& a, const ConditionValue& b, Holds holds) {
    std::optional<double> d = difference(a, b);
    return truth(d && holds(*d));
}

// Sums and the like of texts are 0.
template <class F>
ConditionValue computed(const ConditionValue& a, const ConditionValue& b, F f) {
    return {std::nullopt, a.text || b.text ? 0 : f(a.number, b.number)};
}

using Compute = ConditionValue (*)(const ConditionValue& a, const ConditionValue& b);
using V = const ConditionValue&;

struct OperatorRow {
    std::string_view sign;
    int level;  // 0 binds least
    Compute compute;
};
// Longer signs stand before those that begin like them.
const OperatorRow kOperators[] = {
    {"||", 0, [](V a, V b) { return truth(a.is_true() || b.is_true()); }},
    {"&&", 1, [](V a, V b) { return truth(a.is_true() && b.is_true()); }},
    {"==", 2, [](V a, V b) { return truth(equal(a, b)); }},
    {"!=", 2, [](V a, V b) { return truth(!equal(a, b)); }},
    {"<=", 3, [](V a, V b) { return ordered(a, b, [](double d) { return d <= 0; }); }},
    {">=", 3, [](V a, V b) { return ordered(a, b, [](double d) { return d >= 0; }); }},
    {"<", 3, [](V a, V b) { return ordered(a, b, [](double d) { return d < 0; }); }},
    {">", 3, [](V a, V b) { return ordered(a, b, [](double d) { return d > 0; }); }},
    {"+", 4, [](V a, V b) { return computed(a, b, [](double x, double y) { return x + y; }); }},
    {"-", 4, [](V a, V b) { return computed(a, b, [](double x, double y) { return x - y; }); }},
    {"*", 5, [](V a, V b) { return computed(a, b, [](double x, double y) { return x * y; }); }},
    {"/", 5, [](V a, V b) { return computed(a, b, [](double x, double y) { return x / y; }); }},
    {"%", 5,
     [](V a, V b) { return computed(a, b, [](double x, double y) { return std::fmod(x, y); }); }},
};
constexpr int kUnary = 6;

bool is_name_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '.';
}

class Reader {
  public:
    Reader(std::string_view text, const ConditionLookup& lookup, Condition& out)
        : text_(text), lookup_(lookup), out_(out) {}

    void read() {
        ConditionValue value = binary(0);
        skip_space();
        if (at_ < text_.size()) fail("an operator");
        if (out_.why.empty()) out_.value = value.is_true();
    }

  private:
    void skip_space() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    bool take(std::string_view sign) {
        skip_space();
        if (!text_.substr(at_).starts_with(sign)) return false;
        at_ += sign.size();
        return true;
    }
    ConditionValue fail(std::string_view wanted) {
        if (out_.why.empty())
            out_.why = fmt::format("{} is wanted at '{}'", wanted, text_.substr(at_, 32));
        at_ = text_.size();
        return {};
    }
    const OperatorRow* take_operator(int level) {
        for (const OperatorRow& row : kOperators)
            if (row.level == level && take(row.sign)) return &row;
        return nullptr;
    }

    ConditionValue binary(int level) {
        if (level == kUnary) return unary();
        ConditionValue value = binary(level + 1);
        while (const OperatorRow* row = take_operator(level))
            value = row->compute(value, binary(level + 1));
        return value;
    }
    ConditionValue unary() {
        if (++depth_ > kDeepest) return fail("less depth");
        ConditionValue value = signless();
        --depth_;
        return value;
    }
    ConditionValue signless() {
        if (take("!")) return truth(!unary().is_true());
        if (take("-")) return {std::nullopt, -unary().number};
        if (take("(")) {
            ConditionValue value = binary(0);
            return take(")") ? value : fail("')'");
        }
        if (take("'")) return quoted();
        if (take("$")) return variable();
        if (at_ < text_.size() &&
            (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.'))
            return number();
        return word();
    }

    ConditionValue quoted() {
        size_t end = text_.find('\'', at_);
        if (end == text_.npos) return fail("a quote at the end of a text");
        std::string text(text_.substr(at_, end - at_));
        at_ = end + 1;
        return {std::move(text), 0};
    }
    ConditionValue number() {
        size_t begin = at_;
        while (at_ < text_.size() && (is_name_letter(text_[at_]) || is_exponent_sign(begin))) ++at_;
        std::optional<double> value = number_of<double>(text_.substr(begin, at_ - begin));
        return value ? ConditionValue{std::nullopt, *value} : fail("a number");
    }
    // The sign within 1e-3.
    bool is_exponent_sign(size_t begin) const {
        char c = text_[at_], before = at_ > begin ? text_[at_ - 1] : ' ';
        return (c == '-' || c == '+') && (before == 'e' || before == 'E');
    }
    std::string_view name() {
        skip_space();
        size_t begin = at_;
        while (at_ < text_.size() && is_name_letter(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    // A name behind its $, with or without braces.
    std::string_view variable_name() {
        const bool braces = take("{");
        std::string_view found = name();
        if (found.empty() || (braces && !take("}"))) fail("a name");
        return found;
    }
    ConditionValue variable() {
        std::string_view found = variable_name();
        std::optional<ConditionValue> value = lookup_(found);
        if (!value && out_.unknown.empty()) out_.unknown = found;
        return value.value_or(ConditionValue{});
    }
    // defined(name), defined($name), or a bare word as a text.
    ConditionValue word() {
        std::string_view found = name();
        if (found.empty()) return fail("a value");
        if (found != "defined") return {std::string(found), 0};
        if (!take("(")) return fail("'('");
        std::string_view asked = take("$") ? variable_name() : name();
        if (asked.empty() || !take(")")) return fail("a name and ')'");
        return truth(lookup_(asked).has_value());
    }

    std::string_view text_;
    size_t at_ = 0;
    int depth_ = 0;
    const ConditionLookup& lookup_;
    Condition& out_;
};

}  // namespace

Condition evaluate_condition(std::string_view expression, const ConditionLookup& lookup) {
    Condition out;
    Reader(expression, lookup, out).read();
    return out;
}

}  // namespace kinora::ri
