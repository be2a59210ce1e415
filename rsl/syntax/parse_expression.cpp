// rsl/syntax/parse_expression.cpp: operators by precedence, casts, literals, calls.
#include "rsl/syntax/parse_expression.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "rsl/syntax/chain.h"
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

}  // namespace

int op_level(Op op) {
    for (const OperatorRow& row : kOperators)
        if (row.op == op) return row.level;
    return 9;
}

Expr* ExpressionParser::bad_expression() {
    height_ = 1;
    return make<NumberExpr>(SourceSpan{cursor_.token().where, cursor_.position()});
}

// The expression parsed last is a node over the parts of the given height and of height_.
void ExpressionParser::grow(int part_height) {
    height_ = std::max(height_, part_height) + 1;
    if (height_ > kMostHeight) too_deep();
}

void ExpressionParser::too_deep() {
    errors_.error(Code::RSL_TOO_DEEP, cursor_.token(), fmt::format("{} levels", kMostHeight));
}

Expr* ExpressionParser::expression() {
    Nesting::Level level(nesting_);
    if (nesting_.too_deep()) too_deep();
    if (errors_.panic()) return bad_expression();
    Expr* left = ternary();
    for (const auto& row : kAssignments) {
        if (errors_.panic() || !cursor_.is(row.punct)) continue;
        uint32_t at = cursor_.position();
        int left_height = height_;
        cursor_.advance();
        auto* node = make<AssignExpr>(left->span);
        node->op = row.op;
        node->target = left;
        node->value = expression();
        grow(left_height);
        node->span = cursor_.span_from(left->span, at);
        return node;
    }
    return left;
}

Expr* ExpressionParser::ternary() {
    Expr* condition = binary(1);
    if (errors_.panic() || !cursor_.is(Punct::Question)) return condition;
    Nesting::Level level(nesting_);
    if (nesting_.too_deep()) too_deep();
    uint32_t at = cursor_.position();
    cursor_.advance();
    auto* node = make<SelectExpr>(condition->span);
    node->condition = condition;
    int height = height_;
    node->yes = expression();
    height = std::max(height, height_);
    if (!errors_.panic()) errors_.expect(Punct::Colon, "':'");
    node->no = errors_.panic() ? bad_expression() : ternary();
    grow(height);
    node->span = cursor_.span_from(condition->span, at);
    return node;
}

Expr* ExpressionParser::binary(int lowest) {
    Expr* left = unary();
    int operand_height = height_;  // a chain is one higher than its operands, however long it is
    while (!errors_.panic()) {
        const OperatorRow* row = find_operator(cursor_.token().punct);
        bool word = !row && foreign_.word_operator() != Punct::None;
        if (word) row = find_operator(foreign_.word_operator());
        bool doubled = !row && at_doubled_sign();
        if (doubled) row = find_operator(Punct::Subtract);
        if (!row || row->level < lowest) break;
        uint32_t at = cursor_.position();
        if (word)
            errors_
                .report(Code::RSL_NOT_RSL, cursor_.token(),
                        fmt::format("'{}'", cursor_.token().text))
                .help = fmt::format("write '{}'", op_text(row->op));
        if (!doubled) cursor_.advance();
        auto* node = make<BinaryExpr>(left->span);
        node->op = row->op;
        node->left = left;
        node->right = doubled ? negated(row->level + 1) : binary(row->level + 1);
        operand_height = std::max(operand_height, height_);
        height_ = operand_height;
        grow(0);
        node->span = cursor_.span_from(left->span, at);
        left = node;
    }
    return left;
}

// "a--b": RSL has no decrement, so this is a - (-b).
bool ExpressionParser::at_doubled_sign() const {
    bool operand = cursor_.token(1).kind == TokenKind::Identifier ||
                   cursor_.token(1).kind == TokenKind::Number || cursor_.is(Punct::LeftParen, 1);
    return cursor_.is(Punct::Decrement) && operand;
}

// The operand behind a "--" that stands for "- -".
Expr* ExpressionParser::negated(int lowest) {
    uint32_t at = cursor_.position();
    cursor_.advance();
    auto* node = make<UnaryExpr>({});
    node->op = Op::Negate;
    node->operand = binary(lowest);
    grow(0);
    node->span = cursor_.span_from(at);
    return node;
}

Expr* ExpressionParser::unary() {
    Nesting::Level level(nesting_);
    if (nesting_.too_deep()) too_deep();
    if (errors_.panic()) return bad_expression();
    uint32_t at = cursor_.position();
    if (cursor_.accept(Punct::Add)) return unary();
    bool negates = cursor_.is(Punct::Not) || foreign_.at_not();
    Op op = cursor_.is(Punct::Subtract) ? Op::Negate : negates ? Op::Not : Op::None;
    if (op != Op::None) {
        cursor_.advance();
        auto* node = make<UnaryExpr>({});
        node->op = op;
        node->operand = unary();
        grow(0);
        node->span = cursor_.span_from(at);
        return node;
    }
    if (cursor_.is_type() && !cursor_.word_as_name()) return cast();
    bool c_style = cursor_.is(Punct::LeftParen) && cursor_.is(Punct::RightParen, 2) &&
                   !continues(cursor_.token(3).punct);
    if (c_style && cursor_.is_type(1)) return c_cast();
    return c_style && foreign_.accept_cast() ? unary() : postfix();
}

// "color x", "vector "world" x", "float noise(P)".
Expr* ExpressionParser::cast() {
    uint32_t at = cursor_.position();
    auto* node = make<CastExpr>({});
    node->to = type_from_name(cursor_.token().text);
    cursor_.advance();
    if (cursor_.token().kind == TokenKind::String && node->to != BaseType::String)
        node->space = string();
    node->operand = unary();
    grow(0);
    node->span = cursor_.span_from(at);
    return node;
}

// "(float) x", as in C.
Expr* ExpressionParser::c_cast() {
    uint32_t at = cursor_.position();
    auto* node = make<CastExpr>({});
    node->to = type_from_name(cursor_.token(1).text);
    cursor_.move_to(cursor_.position() + 3);
    node->operand = unary();
    grow(0);
    node->span = cursor_.span_from(at);
    return node;
}

Expr* ExpressionParser::postfix() {
    Expr* operand = primary();
    while (!errors_.panic() && (cursor_.is(Punct::LeftBracket) || cursor_.is(Punct::Arrow))) {
        if (cursor_.is(Punct::Arrow)) {
            operand = member(operand);
            continue;
        }
        uint32_t at = cursor_.position();
        int array_height = height_;
        cursor_.advance();
        auto* node = make<IndexExpr>(operand->span);
        node->array = operand;
        node->index = expression();
        grow(array_height);
        errors_.expect(Punct::RightBracket, "']'");
        node->span = cursor_.span_from(operand->span, at);
        operand = node;
    }
    return operand;
}

// operand->name, of a variable or an element, or operand->name(arguments), also of a call's result.
Expr* ExpressionParser::member(Expr* operand) {
    uint32_t at = cursor_.position();
    auto* element = as_if<IndexExpr>(operand);
    auto* variable = as_if<VariableExpr>(element ? element->array : operand);
    bool method = cursor_.is(Punct::LeftParen, 2);
    bool known = variable || (operand->kind == ExprKind::Call && method);
    if (!known || cursor_.token(1).kind != TokenKind::Identifier) {
        errors_.syntax_error("a member of a variable");
        return bad_expression();
    }
    cursor_.advance();
    const Token& name = cursor_.token();
    if (cursor_.is(Punct::LeftParen, 1)) {
        int object_height = height_;
        auto* node = as_if<CallExpr>(call());
        std::vector<Expr*> args{operand};
        args.insert(args.end(), node->args.begin(), node->args.end());
        node->args = ast_.arena.copy(args);
        node->method = true;
        node->span = cursor_.span_from(operand->span, at + 1);
        grow(object_height);
        return node;
    }
    cursor_.advance();
    std::string path = std::string(variable->name) + "->" + std::string(name.text);
    auto* part = make<VariableExpr>(cursor_.span_from(variable->span, at + 1));
    part->name = ast_.arena.copy(path);
    if (!element) return part;
    auto* node = make<IndexExpr>(cursor_.span_from(operand->span, at + 1));
    node->array = part;
    node->index = element->index;
    return node;
}

Expr* ExpressionParser::primary() {
    const Token& at = cursor_.token();
    height_ = 1;
    if (at.kind == TokenKind::Number) return number();
    if (at.kind == TokenKind::String) return string();
    if (cursor_.is(Punct::LeftParen)) return parenthesised();
    if (at.kind != TokenKind::Identifier || cursor_.is_reserved()) {
        errors_.syntax_error("an expression");
        return bad_expression();
    }
    bool of_base = cursor_.is(Punct::Scope, 1) && cursor_.is(Punct::LeftParen, 3);
    if (cursor_.is(Punct::LeftParen, 1) || of_base) return call();
    auto* node = make<VariableExpr>(SourceSpan{at.where, cursor_.position()});
    node->name = at.text;
    cursor_.advance();
    return node;
}

Expr* ExpressionParser::number() {
    const Token& at = cursor_.token();
    auto* node = make<NumberExpr>(SourceSpan{at.where, cursor_.position()});
    std::string_view text = at.text;
    constexpr double kLargest = std::numeric_limits<float>::max();
    bool too_large = false;
    double value = number_value(text, too_large);
    if (too_large) value = kLargest * 2;
    if (value > kLargest) errors_.report(Code::RSL_BAD_NUMBER, at, text);
    node->value = std::min(value, kLargest);
    cursor_.advance();
    return node;
}

Expr* ExpressionParser::string() {
    uint32_t at = cursor_.position();
    auto* node = make<StringExpr>({});
    std::string value;
    for (; cursor_.token().kind == TokenKind::String; cursor_.advance())
        value += string_value(cursor_.token().text);
    node->value = ast_.arena.copy(value);
    node->span = cursor_.span_from(at);
    return node;
}

// (x), (x, y, z) or sixteen numbers.
Expr* ExpressionParser::parenthesised() {
    uint32_t at = cursor_.position();
    cursor_.advance();
    std::span<Expr*> items = expression_list(Punct::RightParen, "')'");
    if (errors_.panic()) return bad_expression();
    if (items.size() == 1) {
        // The location of a sum has its parentheses; a name or call stands for itself.
        ExprKind kind = items[0]->kind;
        if (kind != ExprKind::Variable && kind != ExprKind::Call)
            items[0]->span.where = cursor_.span_from(at).where;
        return items[0];
    }
    SourceSpan span = cursor_.span_from(at);
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
    errors_.report(Code::RSL_ARGUMENT_FORM, span.where, cursor_.token().macro, "(...)",
                   "3 numbers for a triple or 16 for a matrix");
    return make<NumberExpr>(span);
}

Expr* ExpressionParser::call() {
    uint32_t at = cursor_.position();
    auto* node = make<CallExpr>({});
    node->name = cursor_.token().text;
    node->site = ast_.site_count++;
    cursor_.advance();
    if (cursor_.accept(Punct::Scope)) {  // BASE::method()
        node->name = ast_.arena.copy(fmt::format("{}::{}", node->name, cursor_.token().text));
        cursor_.advance();
    }
    node->args = arguments();
    grow(0);
    node->span = cursor_.span_from(at);
    return node;
}

std::span<Expr*> ExpressionParser::arguments() {
    if (!errors_.expect(Punct::LeftParen, "'('")) return {};
    height_ = 0;
    if (cursor_.accept(Punct::RightParen)) return {};
    return expression_list(Punct::RightParen, nullptr);
}

std::span<Expr*> ExpressionParser::expression_list(Punct end, const char* expected) {
    std::vector<Expr*> items;
    int height = 0;
    do {
        items.push_back(expression());
        height = std::max(height, height_);
    } while (!errors_.panic() && cursor_.accept(Punct::Comma));
    bool statement_ends = cursor_.is(Punct::Semicolon) || cursor_.is(Punct::LeftBrace) ||
                          cursor_.is(Punct::RightBrace);
    if (!expected) expected = statement_ends ? "')'" : "',' or ')'";
    if (!errors_.panic()) errors_.expect(end, expected);
    height_ = height;
    return ast_.arena.copy(items);
}

namespace {

long combined_length(Op op, long a, long b) {
    if (b < 0) return -1;
    long value = -1;
    if (op == Op::Add) value = a + b;
    if (op == Op::Subtract) value = a - b;
    if (op == Op::Multiply) value = a * b;
    if (op == Op::Divide && b > 0) value = a / b;
    return value <= kMostArrayLength ? value : -1;
}

}  // namespace

long constant_length(const Expr& expr) {
    if (const auto* number = as_if<NumberExpr>(&expr)) {
        double value = number->value;
        return value >= 0 && value <= kMostArrayLength && value == std::floor(value) ? long(value)
                                                                                     : -1;
    }
    const auto* last = as_if<BinaryExpr>(&expr);
    if (!last) return -1;
    std::vector<const BinaryExpr*> operators = operators_of(*last);
    long value = constant_length(*operators[0]->left);
    for (const BinaryExpr* node : operators) {
        if (value < 0) return -1;
        value = combined_length(node->op, value, constant_length(*node->right));
    }
    return value;
}

}  // namespace kinora::rsl
