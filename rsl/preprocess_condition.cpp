// rsl/preprocess_condition.cpp: the constant expressions of #if and #elif.
#include <charconv>

#include "rsl/preprocess.h"

namespace kinora::rsl {

namespace {

// Operators by how tight they bind; results are computed in unsigned arithmetic, which wraps.
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
    explicit ConditionParser(const std::vector<Token>& tokens) : tokens_(tokens) {}

    bool parse(long long& value) {
        value = ternary();
        return ok_ && next_ == tokens_.size();
    }

  private:
    Punct punct() const { return next_ < tokens_.size() ? tokens_[next_].punct : Punct::None; }
    bool accept(Punct wanted) {
        if (punct() != wanted) return false;
        ++next_;
        return true;
    }
    long long fail() {
        ok_ = false;
        return 0;
    }

    // What an operand that does not count divides by 0 is no fault (C11 6.5.13, 6.5.14, 6.6).
    template <class Operand>
    long long counted(bool counts, const Operand& operand) {
        uncounted_ += !counts;
        long long value = operand();
        uncounted_ -= !counts;
        return value;
    }
    long long divided_by_zero() { return uncounted_ ? 0 : fail(); }

    long long ternary() {
        if (++depth_ > kMostConditionNesting) return fail();
        long long value = binary(1);
        if (accept(Punct::Question)) {
            long long yes = counted(value != 0, [&] { return ternary(); });
            if (!accept(Punct::Colon)) return fail();
            long long no = counted(value == 0, [&] { return ternary(); });
            value = value ? yes : no;
        }
        --depth_;
        return value;
    }

    long long binary(int lowest) {
        long long left = unary();
        while (ok_) {
            int level = 0;
            Punct op = punct();
            for (const OperatorRow& row : kOperators)
                if (row.punct == op) level = row.level;
            if (level < lowest || level == 0) break;
            ++next_;
            bool counts = !(op == Punct::And && !left) && !(op == Punct::Or && left);
            long long right = counted(counts, [&] { return binary(level + 1); });
            left = apply(op, left, right);
        }
        return left;
    }

    long long apply(Punct op, long long a, long long b) {
        auto ua = static_cast<unsigned long long>(a), ub = static_cast<unsigned long long>(b);
        switch (op) {
            case Punct::Or:
                return a || b;
            case Punct::And:
                return a && b;
            case Punct::BitOr:
                return a | b;
            case Punct::Cross:
                return a ^ b;
            case Punct::BitAnd:
                return a & b;
            case Punct::Equal:
                return a == b;
            case Punct::NotEqual:
                return a != b;
            case Punct::Less:
                return a < b;
            case Punct::LessEqual:
                return a <= b;
            case Punct::Greater:
                return a > b;
            case Punct::GreaterEqual:
                return a >= b;
            case Punct::ShiftLeft:
                return static_cast<long long>(ua << (ub & 63));
            case Punct::ShiftRight:
                return a >> (ub & 63);
            case Punct::Add:
                return static_cast<long long>(ua + ub);
            case Punct::Subtract:
                return static_cast<long long>(ua - ub);
            case Punct::Multiply:
                return static_cast<long long>(ua * ub);
            case Punct::Divide:
                return b == 0 ? divided_by_zero() : b == -1 ? negate(a) : a / b;
            case Punct::Modulo:
                return b == 0 ? divided_by_zero() : b == -1 ? 0 : a % b;
            default:
                return fail();
        }
    }

    static long long negate(long long a) {
        return static_cast<long long>(0ull - static_cast<unsigned long long>(a));
    }

    long long unary() {
        if (++depth_ > kMostConditionNesting) return fail();
        long long value = 0;
        if (accept(Punct::Not))
            value = !unary();
        else if (accept(Punct::Subtract))
            value = negate(unary());
        else if (accept(Punct::Add))
            value = unary();
        else if (accept(Punct::Complement))
            value = ~unary();
        else
            value = primary();
        --depth_;
        return value;
    }

    static bool is_octal(std::string_view text) {
        return text.size() > 1 && text[0] == '0' && text.find_first_not_of("01234567") == text.npos;
    }
    static long long octal(std::string_view text) {
        long long value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value, 8);
        return value;
    }

    long long primary() {
        if (accept(Punct::LeftParen)) {
            long long value = ternary();
            return accept(Punct::RightParen) ? value : fail();
        }
        if (next_ >= tokens_.size()) return fail();
        const Token& token = tokens_[next_++];
        if (token.kind == TokenKind::Identifier) return 0;
        if (token.kind != TokenKind::Number) return fail();
        if (is_octal(token.text)) return octal(token.text);
        bool too_large = false;
        double value = number_value(token.text, too_large);
        return !too_large && value < 9e18 ? static_cast<long long>(value) : 0;
    }

    const std::vector<Token>& tokens_;
    size_t next_ = 0;
    int depth_ = 0, uncounted_ = 0;
    bool ok_ = true;
};

}  // namespace

long long evaluate_condition(const std::vector<Token>& tokens, const Token& at,
                             Reporter& reporter) {
    long long value = 0;
    if (ConditionParser(tokens).parse(value)) return value;
    reporter.report(Code::RSL_BAD_CONDITION, tokens.empty() ? at : tokens[0], at.text);
    return 0;
}

}  // namespace kinora::rsl
