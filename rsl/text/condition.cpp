// rsl/text/condition.cpp: the constant expressions of #if and #elif.
#include "rsl/text/condition.h"

#include <charconv>

#include "rsl/text/lexer.h"

namespace kinora::rsl {

void ConditionStack::open(Location where, bool value) {
    bool outer = !skipping();
    open_.push_back({where, outer && value, !outer || value, false});
}

namespace {

// A value of C's intmax_t or uintmax_t: what #if computes with (C11 6.10.1). Its bits are kept as
// the unsigned one's, whose arithmetic wraps.
struct Integer {
    unsigned long long bits = 0;
    bool is_unsigned = false;

    static Integer of(long long x) { return {static_cast<unsigned long long>(x), false}; }
    long long as_signed() const { return static_cast<long long>(bits); }
    explicit operator bool() const { return bits != 0; }
};

// Operators by how tight they bind.
struct OperatorRow {
    Punct punct;
    int level;
};
constexpr OperatorRow kOperators[] = {
    {Punct::Or, 1},         {Punct::And, 2},     {Punct::BitOr, 3},        {Punct::Cross, 4},
    {Punct::BitAnd, 5},     {Punct::Equal, 6},   {Punct::NotEqual, 6},     {Punct::Less, 7},
    {Punct::LessEqual, 7},  {Punct::Greater, 7}, {Punct::GreaterEqual, 7}, {Punct::ShiftLeft, 8},
    {Punct::ShiftRight, 8}, {Punct::Add, 9},     {Punct::Subtract, 9},     {Punct::Multiply, 10},
    {Punct::Divide, 10},    {Punct::Modulo, 10},
};

class ConditionParser {
  public:
    explicit ConditionParser(const TokenList& tokens) : tokens_(tokens) {}

    bool parse(bool& value) {
        value = bool(ternary());
        return ok_ && next_ == tokens_.size();
    }

  private:
    Punct punct() const { return next_ < tokens_.size() ? tokens_[next_].punct : Punct::None; }
    bool accept(Punct wanted) {
        if (punct() != wanted) return false;
        ++next_;
        return true;
    }
    Integer fail() {
        ok_ = false;
        return {};
    }

    // What an operand that does not count divides by 0 is no fault (C11 6.5.13, 6.5.14, 6.6).
    template <class Operand>
    Integer counted(bool counts, const Operand& operand) {
        uncounted_ += !counts;
        Integer value = operand();
        uncounted_ -= !counts;
        return value;
    }
    Integer divided_by_zero() { return uncounted_ ? Integer() : fail(); }

    Integer ternary() {
        if (++depth_ > kMostConditionNesting) return fail();
        Integer value = binary(1);
        if (accept(Punct::Question)) {
            Integer yes = counted(bool(value), [&] { return ternary(); });
            if (!accept(Punct::Colon)) return fail();
            Integer no = counted(!value, [&] { return ternary(); });
            value = {value ? yes.bits : no.bits, yes.is_unsigned || no.is_unsigned};
        }
        --depth_;
        return value;
    }

    Integer binary(int lowest) {
        Integer left = unary();
        while (ok_) {
            int level = 0;
            Punct op = punct();
            for (const OperatorRow& row : kOperators)
                if (row.punct == op) level = row.level;
            if (level < lowest || level == 0) break;
            ++next_;
            bool counts = !(op == Punct::And && !left) && !(op == Punct::Or && left);
            Integer right = counted(counts, [&] { return binary(level + 1); });
            left = apply(op, left, right);
        }
        return left;
    }

    // Logic and shifts take their operands as they are; all others make both unsigned if one is
    // (C11 6.3.1.8).
    Integer apply(Punct op, Integer a, Integer b) {
        bool is_unsigned = a.is_unsigned || b.is_unsigned;
        auto whole = [&](unsigned long long bits) { return Integer{bits, is_unsigned}; };
        switch (op) {
            case Punct::Or:
                return Integer::of(a || b);
            case Punct::And:
                return Integer::of(a && b);
            case Punct::BitOr:
                return whole(a.bits | b.bits);
            case Punct::Cross:
                return whole(a.bits ^ b.bits);
            case Punct::BitAnd:
                return whole(a.bits & b.bits);
            case Punct::Equal:
                return Integer::of(a.bits == b.bits);
            case Punct::NotEqual:
                return Integer::of(a.bits != b.bits);
            case Punct::Less:
                return Integer::of(less(a, b));
            case Punct::LessEqual:
                return Integer::of(!less(b, a));
            case Punct::Greater:
                return Integer::of(less(b, a));
            case Punct::GreaterEqual:
                return Integer::of(!less(a, b));
            case Punct::ShiftLeft:
                return {a.bits << (b.bits & 63), a.is_unsigned};
            case Punct::ShiftRight:
                if (a.is_unsigned) return {a.bits >> (b.bits & 63), true};
                return Integer::of(a.as_signed() >> (b.bits & 63));
            case Punct::Add:
                return whole(a.bits + b.bits);
            case Punct::Subtract:
                return whole(a.bits - b.bits);
            case Punct::Multiply:
                return whole(a.bits * b.bits);
            case Punct::Divide:
                if (!b) return divided_by_zero();
                if (is_unsigned) return whole(a.bits / b.bits);
                return b.as_signed() == -1 ? negated(a)
                                           : Integer::of(a.as_signed() / b.as_signed());
            case Punct::Modulo:
                if (!b) return divided_by_zero();
                if (is_unsigned) return whole(a.bits % b.bits);
                return Integer::of(b.as_signed() == -1 ? 0 : a.as_signed() % b.as_signed());
            default:
                return fail();
        }
    }

    static bool less(Integer a, Integer b) {
        return a.is_unsigned || b.is_unsigned ? a.bits < b.bits : a.as_signed() < b.as_signed();
    }
    static Integer negated(Integer a) { return {0 - a.bits, a.is_unsigned}; }

    Integer unary() {
        if (++depth_ > kMostConditionNesting) return fail();
        Integer value;
        if (accept(Punct::Not))
            value = Integer::of(!unary());
        else if (accept(Punct::Subtract))
            value = negated(unary());
        else if (accept(Punct::Add))
            value = unary();
        else if (accept(Punct::Complement))
            value = complement(unary());
        else
            value = primary();
        --depth_;
        return value;
    }
    static Integer complement(Integer a) { return {~a.bits, a.is_unsigned}; }

    Integer primary() {
        if (accept(Punct::LeftParen)) {
            Integer value = ternary();
            return accept(Punct::RightParen) ? value : fail();
        }
        if (next_ >= tokens_.size()) return fail();
        const Token& token = tokens_[next_++];
        if (token.kind == TokenKind::Identifier) return {};
        if (is_character_constant(token)) return Integer::of(character_value(token.text));
        return token.kind == TokenKind::Number ? number(token.text) : fail();
    }

    // Decimal, octal (if all its digits are) or hexadecimal; what no integer is loses its fraction.
    static Integer number(std::string_view text) {
        bool hex = text.size() > 2 && (text[1] == 'x' || text[1] == 'X');
        bool octal = !hex && text.size() > 1 && text[0] == '0';
        size_t end = text.find_first_not_of(hex     ? "0123456789abcdefABCDEF"
                                            : octal ? "01234567"
                                                    : "0123456789",
                                            hex ? 2 : 0);
        std::string_view suffix = end == text.npos ? "" : text.substr(end);
        if (suffix.find_first_not_of("uUlL") != suffix.npos) return rounded(text);
        Integer value;
        const char* begin = text.data() + (hex ? 2 : 0);
        std::from_chars(begin, text.data() + text.size(), value.bits, hex ? 16 : octal ? 8 : 10);
        // Too large for the signed type: as other preprocessors read it.
        value.is_unsigned = suffix.find_first_of("uU") != suffix.npos || value.as_signed() < 0;
        return value;
    }
    static Integer rounded(std::string_view text) {
        bool too_large = false;
        double value = number_value(text, too_large);
        return Integer::of(!too_large && value < 9e18 ? static_cast<long long>(value) : 0);
    }

    const TokenList& tokens_;
    size_t next_ = 0;
    int depth_ = 0, uncounted_ = 0;
    bool ok_ = true;
};

}  // namespace

bool evaluate_condition(const TokenList& tokens, const Token& at, Reporter& reporter) {
    bool value = false;
    if (ConditionParser(tokens).parse(value)) return value;
    reporter.report(Code::RSL_BAD_CONDITION, tokens.empty() ? at : tokens[0], at.text);
    return false;
}

}  // namespace kinora::rsl
