// rsl/check/operator.cpp: unary and binary operators.
#include "rsl/check/convert.h"
#include "rsl/check/expression.h"
#include "rsl/syntax/chain.h"

namespace kinora::rsl {

namespace {

// One of the operands has a finding.
bool invalid(const BinaryExpr& e) {
    return e.left->type.base == BaseType::Invalid || e.right->type.base == BaseType::Invalid;
}

constexpr std::string_view kComponentLetters = "xyzrgb";

bool is_logical(Op op) {
    return op == Op::And || op == Op::Or;
}
bool is_product(Op op) {
    return op == Op::Dot || op == Op::Cross;
}
bool is_comparison(Op op) {
    return op >= Op::Less && op <= Op::NotEqual;
}

// What is wanted of operands whose types the context chooses, where `wanted` is of the whole.
BaseType operand_wanted(Op op, BaseType wanted) {
    if (is_comparison(op)) return BaseType::Float;
    return is_product(op) ? BaseType::Vector : wanted;
}

// What is wanted of the flexible operand beside one of the type `other`. A sum wants equal types.
// In a product with a triple, a noise() or texture() of no stated type is a factor: float
// ("P += N * noise(P)"); but beside a color a picture is one ("Cs * texture(name)").
BaseType beside(Op op, BaseType other, const OperandTypes& flexible, BaseType wanted) {
    if (is_comparison(op)) return other;
    if (is_product(op)) return is_triple(other) ? other : BaseType::Vector;
    if (!is_triple(other)) return wanted;
    if (other == BaseType::Color && flexible.picture) return other;
    bool factor = op == Op::Multiply || op == Op::Divide;
    return factor && flexible.can_be(BaseType::Float) ? BaseType::Float : other;
}

}  // namespace

void ExpressionChecker::check(Expr*&, UnaryExpr& e, BaseType wanted) {
    if (e.op == Op::Not) {
        condition(e.operand);
        e.type = {BaseType::Bool, -1};
        return;
    }
    BaseType type = value(e.operand, wanted);
    if (type == BaseType::Invalid) return;
    if (type == BaseType::Bool) convert(e.operand, type = BaseType::Float);
    if (is_numeric(type))
        e.type = {type, -1};
    else
        reporter_.report(Code::RSL_BAD_OPERAND, e.span, op_text(e.op), type_name(type));
}

// a == b and a != b of whole arrays: calls of arrayequal().
bool ExpressionChecker::compare_arrays(Expr*& slot, BinaryExpr& e) {
    auto is_array = [&](const Expr* side) {
        const auto* named = as_if<VariableExpr>(side);
        const Symbol* symbol = named ? scopes_.find_variable(named->name) : nullptr;
        return symbol && symbol->type.is_array();
    };
    bool equality = e.op == Op::Equal || e.op == Op::NotEqual;
    if (!equality || !is_array(e.left) || !is_array(e.right)) return false;
    auto* call = ast_.make<CallExpr>(e.span);
    call->name = "arrayequal";
    call->site = ast_.site_count++;
    call->args = ast_.arena.copy(std::vector<Expr*>{e.left, e.right});
    slot = call;
    if (e.op == Op::NotEqual) {
        auto* differ = ast_.make<UnaryExpr>(e.span);
        differ->op = Op::Not;
        differ->operand = call;
        slot = differ;
    }
    return true;
}

// Along the chain by loops: downwards what is wanted of each left operand, upwards the types.
void ExpressionChecker::check(Expr*& slot, BinaryExpr& last, BaseType wanted) {
    std::vector<BinaryExpr*> chain = operators_of(last);
    if (compare_arrays(chain.size() > 1 ? chain[1]->left : slot, *chain[0]))
        chain.erase(chain.begin());
    if (chain.empty()) return expression(slot, BaseType::Float);
    const std::vector<OperandTypes> lefts = types_.left_operands(chain);
    std::vector<OperatorSides> sides(chain.size());
    for (size_t i = chain.size(); i-- > 0;) {
        sides[i].left = lefts[i];
        wanted = before_left(*chain[i], sides[i], wanted);
    }
    value(chain[0]->left, wanted);
    for (size_t i = 0; i < chain.size(); ++i) after_left(*chain[i], sides[i]);
}

// What is wanted of the left operand. Of a fixed and a flexible operand the fixed one is checked
// first, so that it can help the other.
BaseType ExpressionChecker::before_left(BinaryExpr& e, OperatorSides& sides, BaseType wanted) {
    if (is_logical(e.op)) return BaseType::Float;
    sides.component = is_component_by_name(e);
    if (sides.component) return BaseType::Invalid;
    sides.wanted = operand_wanted(e.op, wanted);
    sides.right_flexible = types_.is_flexible(*e.right);
    if (!sides.left.flexible) return BaseType::Invalid;
    if (sides.right_flexible) return sides.wanted;
    sides.right_checked = true;
    return beside(e.op, value(e.right, BaseType::Invalid), sides.left, sides.wanted);
}

void ExpressionChecker::after_left(BinaryExpr& e, const OperatorSides& sides) {
    if (is_logical(e.op)) {
        to_condition(e.left);
        condition(e.right);
        e.type = {BaseType::Bool, -1};
        return;
    }
    if (sides.component) return component_by_name(e);
    if (sides.right_flexible && !sides.left.flexible)
        value(e.right, beside(e.op, e.left->type.base, types_.operand(*e.right), sides.wanted));
    else if (!sides.right_checked)
        value(e.right, sides.right_flexible ? sides.wanted : BaseType::Invalid);
    if (invalid(e)) return;
    if (is_product(e.op)) return check_product(e);
    return is_comparison(e.op) ? check_comparison(e) : check_arithmetic(e);
}

void ExpressionChecker::bad_operands(BinaryExpr& e) {
    BaseType left = e.left->type.base, right = e.right->type.base;
    Finding& finding = reporter_.report(Code::RSL_BAD_OPERANDS, e.span, op_text(e.op),
                                        type_name(left), type_name(right));
    bool matrix = left == BaseType::Matrix || right == BaseType::Matrix;
    if (left == BaseType::String && right == left && e.op == Op::Add)
        finding.help = "use concat(a, b)";
    else if (left == BaseType::String && right == left && e.op >= Op::Less && e.op <= Op::NotEqual)
        finding.help = "strings are compared by == and !=";
    else if (matrix && e.op == Op::Multiply)
        finding.help = "use transform(m, p)";
    else if (e.op == Op::Dot && left == BaseType::Float && right == left)
        finding.help = "write 'a * b'";
}

void ExpressionChecker::check_arithmetic(BinaryExpr& e) {
    bool product = e.op == Op::Multiply || e.op == Op::Divide;
    BaseType left = e.left->type.base, right = e.right->type.base;
    BaseType common = common_type(left, right);
    bool applies = is_numeric(common) && (common != BaseType::Matrix || product);
    if (!applies) return bad_operands(e);
    convert(e.left, common);
    convert(e.right, common);
    bool difference = e.op == Op::Subtract && left == BaseType::Point && right == BaseType::Point;
    e.type = {difference ? BaseType::Vector : common, -1};
}

// "P.x" as in other languages.
bool ExpressionChecker::is_component_by_name(const BinaryExpr& e) const {
    const auto* name = e.op == Op::Dot ? as_if<VariableExpr>(e.right) : nullptr;
    bool letter = name && name->name.size() == 1 &&
                  kComponentLetters.find(name->name[0]) != std::string_view::npos;
    return letter && !scopes_.find_variable(name->name);
}
void ExpressionChecker::component_by_name(BinaryExpr& e) {
    const auto& name = as<VariableExpr>(*e.right);
    size_t k = kComponentLetters.find(name.name[0]);
    reporter_.report(Code::RSL_NOT_RSL, name.span, fmt::format("the component '.{}'", name.name))
        .help =
        k < 3 ? fmt::format("write {}comp(p)", name.name) : fmt::format("write comp(c, {})", k - 3);
    e.type = {BaseType::Float, -1};
}

// a . b and a ^ b.
void ExpressionChecker::check_product(BinaryExpr& e) {
    BaseType left = e.left->type.base, right = e.right->type.base;
    if (!is_triple(left) || !is_triple(right)) return bad_operands(e);
    BaseType common = left == right && is_spatial(left) ? left : BaseType::Vector;
    convert(e.left, common);
    convert(e.right, common);
    e.type = {e.op == Op::Dot ? BaseType::Float : BaseType::Vector, -1};
}

void ExpressionChecker::check_comparison(BinaryExpr& e) {
    BaseType common = common_type(e.left->type.base, e.right->type.base);
    bool equality = e.op == Op::Equal || e.op == Op::NotEqual;
    if (is_triple(common) && !equality)
        reporter_.report(Code::RSL_TRIPLE_ORDER, e.span, op_text(e.op), type_name(common));
    bool applies = common == BaseType::Float || is_triple(common) ||
                   (equality && (is_numeric(common) || common == BaseType::String));
    if (!applies) return bad_operands(e);
    convert(e.left, common);
    convert(e.right, common);
    e.type = {BaseType::Bool, -1};
}

}  // namespace kinora::rsl
