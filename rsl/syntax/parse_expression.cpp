// rsl/syntax/parse_expression.cpp: expressions, by precedence climbing.
#include <cmath>
#include <limits>

#include "rsl/syntax/parser.h"
#include "rsl/text/lexer.h"

namespace kinora::rsl {

namespace {

// The specification's order: '^' binds looser than '*', '.' tighter.
struct OperatorRow {
    Punct punct;
    Op op;
    int level;
};
constexpr OperatorRow kOperators[] = {
    {Punct::Or, Op::Or, 1},           {Punct::And, Op::And, 2},
    {Punct::Equal, Op::Equal, 3},     {Punct::NotEqual, Op::NotEqual, 3},
    {Punct::Less, Op::Less, 4},       {Punct::LessEqual, Op::LessEqual, 4},
    {Punct::Greater, Op::Greater, 4}, {Punct::GreaterEqual, Op::GreaterEqual, 4},
    {Punct::Add, Op::Add, 5},         {Punct::Subtract, Op::Subtract, 5},
    {Punct::Cross, Op::Cross, 6},     {Punct::Multiply, Op::Multiply, 7},
    {Punct::Divide, Op::Divide, 7},   {Punct::Dot, Op::Dot, 8},
};

// What may follow a variable in parentheses but not a cast.
bool continues(Punct punct) {
    if (punct == Punct::Semicolon || punct == Punct::RightParen || punct == Punct::Comma)
        return true;
    return punct != Punct::Add && punct != Punct::Subtract && punct != Punct::None &&
           punct != Punct::LeftParen && punct != Punct::Not;
}

const OperatorRow* find_operator(Punct punct) {
    for (const OperatorRow& row : kOperators)
        if (row.punct == punct) return &row;
    return nullptr;
}

constexpr struct {
    Punct punct;
    Op op;
} kAssignments[] = {{Punct::Assign, Op::None},
                    {Punct::AddAssign, Op::Add},
                    {Punct::SubtractAssign, Op::Subtract},
                    {Punct::MultiplyAssign, Op::Multiply},
                    {Punct::DivideAssign, Op::Divide}};

struct Depth {
    explicit Depth(int& depth) : depth_(depth) { ++depth_; }
    ~Depth() { --depth_; }
    int& depth_;
};

}  // namespace

int op_level(Op op) {
    for (const OperatorRow& row : kOperators)
        if (row.op == op) return row.level;
    return 9;
}

Expr* Parser::bad_expression() {
    height_ = 1;
    return make<NumberExpr>(SourceSpan{token().where, next_});
}

// The expression parsed last is a node over the parts of the given height and of height_.
void Parser::grow(int part_height) {
    height_ = std::max(height_, part_height) + 1;
    if (height_ > kMostHeight) error(Code::RSL_TOO_DEEP, token());
}

Expr* Parser::expression() {
    Depth depth(depth_);
    if (depth_ > kMostNesting) error(Code::RSL_TOO_DEEP, token());
    if (panic_) return bad_expression();
    Expr* left = ternary();
    for (const auto& row : kAssignments) {
        if (panic_ || !is(row.punct)) continue;
        uint32_t at = next_;
        int left_height = height_;
        advance();
        auto* node = make<AssignExpr>(left->span);
        node->op = row.op;
        node->target = left;
        node->value = expression();
        grow(left_height);
        node->span = span_from(left->span, at);
        return node;
    }
    return left;
}

Expr* Parser::ternary() {
    Expr* condition = binary(1);
    if (panic_ || !is(Punct::Question)) return condition;
    Depth depth(depth_);
    if (depth_ > kMostNesting) error(Code::RSL_TOO_DEEP, token());
    uint32_t at = next_;
    advance();
    auto* node = make<SelectExpr>(condition->span);
    node->condition = condition;
    int height = height_;
    node->yes = expression();
    height = std::max(height, height_);
    if (!panic_) expect(Punct::Colon, "':'");
    node->no = panic_ ? bad_expression() : ternary();
    grow(height);
    node->span = span_from(condition->span, at);
    return node;
}

Expr* Parser::binary(int lowest) {
    Expr* left = unary();
    while (!panic_) {
        const OperatorRow* row = find_operator(token().punct);
        bool word = !row && word_operator() != Punct::None;
        if (word) row = find_operator(word_operator());
        bool doubled = !row && at_doubled_sign();
        if (doubled) row = find_operator(Punct::Subtract);
        if (!row || row->level < lowest) break;
        uint32_t at = next_;
        if (word)
            reporter_.report(Code::RSL_NOT_RSL, token(), fmt::format("'{}'", token().text)).help =
                fmt::format("write '{}'", op_text(row->op));
        int left_height = height_;
        if (!doubled) advance();
        auto* node = make<BinaryExpr>(left->span);
        node->op = row->op;
        node->left = left;
        node->right = doubled ? negated(row->level + 1) : binary(row->level + 1);
        grow(left_height);
        node->span = span_from(left->span, at);
        left = node;
    }
    return left;
}

// "a--b": RSL has no decrement, so this is a - (-b).
bool Parser::at_doubled_sign() const {
    bool operand = token(1).kind == TokenKind::Identifier || token(1).kind == TokenKind::Number ||
                   is(Punct::LeftParen, 1);
    return is(Punct::Decrement) && operand;
}

// The operand behind a "--" that stands for "- -".
Expr* Parser::negated(int lowest) {
    uint32_t at = next_;
    advance();
    auto* node = make<UnaryExpr>({});
    node->op = Op::Negate;
    node->operand = binary(lowest);
    grow(0);
    node->span = span_from(at);
    return node;
}

Expr* Parser::unary() {
    Depth depth(depth_);
    if (depth_ > kMostNesting) error(Code::RSL_TOO_DEEP, token());
    if (panic_) return bad_expression();
    uint32_t at = next_;
    if (accept(Punct::Add)) return unary();
    bool negates = is(Punct::Not) || word_not();
    Op op = is(Punct::Subtract) ? Op::Negate : negates ? Op::Not : Op::None;
    if (op != Op::None) {
        advance();
        auto* node = make<UnaryExpr>({});
        node->op = op;
        node->operand = unary();
        grow(0);
        node->span = span_from(at);
        return node;
    }
    if (is_type() && !word_as_name()) return cast();
    bool c_style = is(Punct::LeftParen) && is(Punct::RightParen, 2) && !continues(token(3).punct);
    if (c_style && is_type(1)) return c_cast();
    return c_style && foreign_cast() ? unary() : postfix();
}

// "color x", "vector "world" x", "float noise(P)".
Expr* Parser::cast() {
    uint32_t at = next_;
    auto* node = make<CastExpr>({});
    node->to = type_from_name(token().text);
    advance();
    if (token().kind == TokenKind::String && node->to != BaseType::String) node->space = string();
    node->operand = unary();
    grow(0);
    node->span = span_from(at);
    return node;
}

// "(float) x", as in C.
Expr* Parser::c_cast() {
    uint32_t at = next_;
    auto* node = make<CastExpr>({});
    node->to = type_from_name(token(1).text);
    next_ += 3;
    node->operand = unary();
    grow(0);
    node->span = span_from(at);
    return node;
}

Expr* Parser::postfix() {
    Expr* operand = primary();
    while (!panic_ && is(Punct::LeftBracket)) {
        uint32_t at = next_;
        int array_height = height_;
        advance();
        auto* node = make<IndexExpr>(operand->span);
        node->array = operand;
        node->index = expression();
        grow(array_height);
        expect(Punct::RightBracket, "']'");
        node->span = span_from(operand->span, at);
        operand = node;
    }
    return operand;
}

Expr* Parser::primary() {
    const Token& at = token();
    height_ = 1;
    if (at.kind == TokenKind::Number) return number();
    if (at.kind == TokenKind::String) return string();
    if (is(Punct::LeftParen)) return parenthesised();
    if (at.kind != TokenKind::Identifier || is_reserved()) {
        syntax_error("an expression");
        return bad_expression();
    }
    if (is(Punct::LeftParen, 1)) return call();
    auto* node = make<VariableExpr>(SourceSpan{at.where, next_});
    node->name = at.text;
    advance();
    return node;
}

Expr* Parser::number() {
    const Token& at = token();
    auto* node = make<NumberExpr>(SourceSpan{at.where, next_});
    std::string_view text = at.text;
    constexpr double kLargest = std::numeric_limits<float>::max();
    bool too_large = false;
    double value = number_value(text, too_large);
    if (too_large) value = kLargest * 2;
    if (value > kLargest) reporter_.report(Code::RSL_BAD_NUMBER, at, text);
    node->value = std::min(value, kLargest);
    advance();
    return node;
}

Expr* Parser::string() {
    uint32_t at = next_;
    auto* node = make<StringExpr>({});
    std::string value;
    for (; token().kind == TokenKind::String; advance()) value += string_value(token().text);
    node->value = ast_.arena.copy(value);
    node->span = span_from(at);
    return node;
}

// (x), (x, y, z) or sixteen numbers.
Expr* Parser::parenthesised() {
    uint32_t at = next_;
    advance();
    std::span<Expr*> items = expression_list(Punct::RightParen, "')'");
    if (panic_) return bad_expression();
    if (items.size() == 1) {
        // A sum's place has its parentheses; a name or call stands for itself.
        ExprKind kind = items[0]->kind;
        if (kind != ExprKind::Variable && kind != ExprKind::Call)
            items[0]->span.where = span_from(at).where;
        return items[0];
    }
    SourceSpan span = span_from(at);
    grow(0);
    if (items.size() == 3) {
        auto* node = make<TripleExpr>(span);
        std::copy(items.begin(), items.end(), node->items);
        return node;
    }
    if (items.size() == 16) {
        auto* node = make<SixteenExpr>(span);
        node->items = items;
        return node;
    }
    reporter_.report(Code::RSL_ARGUMENT_FORM, span.where, token().macro, {}, "(...)",
                     "3 numbers for a triple or 16 for a matrix");
    return make<NumberExpr>(span);
}

Expr* Parser::call() {
    uint32_t at = next_;
    auto* node = make<CallExpr>({});
    node->name = token().text;
    node->site = ast_.site_count++;
    advance();
    node->args = arguments();
    grow(0);
    node->span = span_from(at);
    return node;
}

std::span<Expr*> Parser::arguments() {
    if (!expect(Punct::LeftParen, "'('")) return {};
    height_ = 0;
    if (accept(Punct::RightParen)) return {};
    return expression_list(Punct::RightParen, nullptr);
}

// "a, b, c" and the closing token; without `expected`, of arguments.
std::span<Expr*> Parser::expression_list(Punct end, const char* expected) {
    std::vector<Expr*> items;
    int height = 0;
    do {
        items.push_back(expression());
        height = std::max(height, height_);
    } while (!panic_ && accept(Punct::Comma));
    bool statement_ends = is(Punct::Semicolon) || is(Punct::LeftBrace) || is(Punct::RightBrace);
    if (!expected) expected = statement_ends ? "')'" : "',' or ')'";
    if (!panic_) expect(end, expected);
    height_ = height;
    return ast_.arena.copy(items);
}

long constant_length(const Expr& expr) {
    if (const auto* number = as_if<NumberExpr>(&expr)) {
        double value = number->value;
        return value >= 0 && value <= kMostArrayLength && value == std::floor(value) ? long(value)
                                                                                     : -1;
    }
    const auto* node = as_if<BinaryExpr>(&expr);
    if (!node) return -1;
    long a = constant_length(*node->left), b = constant_length(*node->right);
    if (a < 0 || b < 0) return -1;
    long value = -1;
    if (node->op == Op::Add) value = a + b;
    if (node->op == Op::Subtract) value = a - b;
    if (node->op == Op::Multiply) value = a * b;
    if (node->op == Op::Divide && b > 0) value = a / b;
    return value <= kMostArrayLength ? value : -1;
}

}  // namespace kinora::rsl
