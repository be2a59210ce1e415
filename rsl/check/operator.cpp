// rsl/check/operator.cpp: unary and binary operators.
#include "rsl/check/convert.h"
#include "rsl/check/expression.h"

namespace kinora::rsl {

namespace {

// One of the operands has a finding.
bool invalid(const BinaryExpr& e) {
    return e.left->type.base == BaseType::Invalid || e.right->type.base == BaseType::Invalid;
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
    expression(slot, BaseType::Float);
    return true;
}

void ExpressionChecker::check(Expr*& slot, BinaryExpr& e, BaseType wanted) {
    switch (e.op) {
        case Op::And:
        case Op::Or:
            condition(e.left);
            condition(e.right);
            e.type = {BaseType::Bool, -1};
            return;
        case Op::Dot:
        case Op::Cross:
            return check_product(e);
        case Op::Add:
        case Op::Subtract:
        case Op::Multiply:
        case Op::Divide:
            return check_arithmetic(e, wanted);
        default:
            if (!compare_arrays(slot, e)) check_comparison(e);
    }
}

// Checks both operands, the one of fixed type first, so that it can help the other: hint(type of
// the fixed one, the flexible one) is what the flexible one is asked to be.
template <class Hint>
void ExpressionChecker::both_sides(Expr*& left, Expr*& right, BaseType wanted, Hint hint) {
    bool left_flexible = types_.is_flexible(*left), right_flexible = types_.is_flexible(*right);
    if (left_flexible == right_flexible) {
        value(left, left_flexible ? wanted : BaseType::Invalid);
        value(right, right_flexible ? wanted : BaseType::Invalid);
        return;
    }
    Expr*& fixed = left_flexible ? right : left;
    Expr*& flexible = left_flexible ? left : right;
    BaseType type = value(fixed, BaseType::Invalid);
    value(flexible, hint(type, *flexible));
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

// A sum wants equal types. In a product with a triple, a noise() or texture() of no stated type is
// a factor: float ("P += N * noise(P)"); but beside a color a picture is one ("Cs *
// texture(name)").
void ExpressionChecker::check_arithmetic(BinaryExpr& e, BaseType wanted) {
    bool product = e.op == Op::Multiply || e.op == Op::Divide;
    both_sides(e.left, e.right, wanted, [&](BaseType other, const Expr& flexible) {
        if (!is_triple(other)) return wanted;
        if (other == BaseType::Color && is_picture(flexible)) return other;
        return product && types_.can_be(flexible, BaseType::Float) ? BaseType::Float : other;
    });
    if (invalid(e)) return;
    BaseType left = e.left->type.base, right = e.right->type.base;
    BaseType common = common_type(left, right);
    bool applies = is_numeric(common) && (common != BaseType::Matrix || product);
    if (!applies) return bad_operands(e);
    convert(e.left, common);
    convert(e.right, common);
    bool difference = e.op == Op::Subtract && left == BaseType::Point && right == BaseType::Point;
    e.type = {difference ? BaseType::Vector : common, -1};
}

// "P.x" as in other languages; reported.
bool ExpressionChecker::component_by_name(BinaryExpr& e) {
    constexpr std::string_view kPositions = "xyz", kColors = "rgb";
    const auto* name = e.op == Op::Dot ? as_if<VariableExpr>(e.right) : nullptr;
    if (!name || name->name.size() != 1 || scopes_.find_variable(name->name)) return false;
    size_t position = kPositions.find(name->name[0]), color = kColors.find(name->name[0]);
    if (position == kPositions.npos && color == kColors.npos) return false;
    value(e.left, BaseType::Invalid);
    size_t k = position == kPositions.npos ? color : position;
    reporter_.report(Code::RSL_NOT_RSL, name->span, fmt::format("the component '.{}'", name->name))
        .help = position == kPositions.npos ? fmt::format("write comp(c, {})", k)
                                            : fmt::format("write {}comp(p)", kPositions[k]);
    e.type = {BaseType::Float, -1};
    return true;
}

// a . b and a ^ b.
void ExpressionChecker::check_product(BinaryExpr& e) {
    if (component_by_name(e)) return;
    both_sides(e.left, e.right, BaseType::Vector, [](BaseType other, const Expr&) {
        return is_triple(other) ? other : BaseType::Vector;
    });
    if (invalid(e)) return;
    BaseType left = e.left->type.base, right = e.right->type.base;
    if (!is_triple(left) || !is_triple(right)) return bad_operands(e);
    BaseType common = left == right && is_spatial(left) ? left : BaseType::Vector;
    convert(e.left, common);
    convert(e.right, common);
    e.type = {e.op == Op::Dot ? BaseType::Float : BaseType::Vector, -1};
}

void ExpressionChecker::check_comparison(BinaryExpr& e) {
    both_sides(e.left, e.right, BaseType::Float, [](BaseType other, const Expr&) { return other; });
    if (invalid(e)) return;
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
