// rsl/lower/expressions.cpp: expressions as IR values.
#include "rsl/lower/expressions.h"

#include <optional>

#include "rsl/lower/values.h"
#include "rsl/model/changes.h"
#include "rsl/syntax/chain.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

namespace {

// Positions of instructions: an expression's own is back after its operands are written.
class PositionScope {
  public:
    PositionScope(jit::Builder& builder, Location where, Location& current)
        : b_(builder), current_(current), before_(current) {
        b_.set_location(current_ = where);
    }
    ~PositionScope() { b_.set_location(current_ = before_); }

  private:
    jit::Builder& b_;
    Location& current_;
    Location before_;
};

}  // namespace

Lowered Expressions::expr(const Expr& e) {
    PositionScope position(b_, e.span.where, where_);
    switch (e.kind) {
        case ExprKind::Number:
            return lowered(BaseType::Float, b_.f(float(as<NumberExpr>(e).value)));
        case ExprKind::String:
            return lowered(BaseType::String, b_.i(intern(as<StringExpr>(e).value)));
        case ExprKind::Variable:
            return variables_.read(*as<VariableExpr>(e).symbol);
        case ExprKind::Index:
            return variables_.load(variables_.target(e));
        case ExprKind::Component: {
            auto& node = as<ComponentExpr>(e);
            V3 v = expr(*node.operand).v3();
            return lowered(BaseType::Float, pick(e_, v, e_.index(value(*node.index), 3)));
        }
        case ExprKind::Unary: {
            auto& node = as<UnaryExpr>(e);
            Lowered x = expr(*node.operand);
            for (int c = 0; c < x.size(); ++c)
                x.c[size_t(c)] =
                    node.op == Op::Not ? b_.logical_not(x.c[size_t(c)]) : b_.neg(x.c[size_t(c)]);
            return x;
        }
        case ExprKind::Binary:
            return chain(e);
        case ExprKind::Select:
            return select_expr(as<SelectExpr>(e));
        case ExprKind::Assign:
            return assign(as<AssignExpr>(e));
        case ExprKind::Call:
            return as<CallExpr>(e).function ? calls_.lower(as<CallExpr>(e))
                                            : lower_builtin(tools_, as<CallExpr>(e));
        case ExprKind::Cast:
            return cast(as<CastExpr>(e));
        case ExprKind::Triple: {
            Lowered x{e.type.base, {}};
            for (size_t c = 0; c < 3; ++c) x.c[c] = value(*as<TripleExpr>(e).items[c]);
            return x;
        }
        case ExprKind::Sixteen: {
            Lowered x{BaseType::Matrix, {}};
            for (size_t c = 0; c < 16; ++c) x.c[c] = value(*as<SixteenExpr>(e).items[c]);
            return x;
        }
        case ExprKind::ArrayLiteral:
            break;  // only an initialiser: fill_array
    }
    CHECK(false);
    return {};
}

Lowered Expressions::cast(const CastExpr& e) {
    Lowered x = convert(e_, expr(*e.operand), e.to);
    if (!e.space) return x;
    Value name = value(*e.space);
    if (e.to != BaseType::Color)
        return spaces_.to_current(x, spaces_.space(name, e.space->span.where));
    if (const std::string* text = e_.constant_text(name))
        return color_space(e_, context_, x, *text, "rgb", e.space->span.where);
    context_.error(Code::RSL_STRING_NOT_CONSTANT, e.space->span.where, "color");
    return x;
}

// Is `e` a product of floats or triples (perhaps a float one, spread to `type`)? Then its factors.
bool Expressions::as_product(const Expr& e, BaseType type, Lowered& x, Lowered& y) {
    if (auto* c = as_if<CastExpr>(&e); c && c->implicit && !c->space) {
        if (!as_product(*c->operand, c->operand->type.base, x, y)) return false;
        x = convert(e_, x, type);
        y = convert(e_, y, type);
        return true;
    }
    auto* product = as_if<BinaryExpr>(&e);
    if (!product || product->op != Op::Multiply || type == BaseType::Matrix) return false;
    x = expr(*product->left);
    y = expr(*product->right);
    return true;
}

// Is the product at `at` the left operand of a sum, perhaps by casts?
static bool is_summed(std::span<const Expr* const> links, size_t at) {
    if (links[at]->type.base == BaseType::Matrix) return false;
    size_t next = at + 1;
    while (next < links.size() && links[next]->kind == ExprKind::Cast) ++next;
    const auto* node = next < links.size() ? as_if<BinaryExpr>(links[next]) : nullptr;
    return node && (node->op == Op::Add || node->op == Op::Subtract);
}

// Operators from left to right. a * b + c of one expression rounds once
// (docs/decisions.md#exact-arithmetic), so such a product waits for its sum.
Lowered Expressions::chain(const Expr& last) {
    const Chain<const Expr> parts = chain_of(last);
    Lowered left = expr(*parts.first);
    std::optional<Lowered> factor;  // `left` times this is meant
    for (size_t i = 0; i < parts.links.size(); ++i) {
        const Expr& link = *parts.links[i];
        PositionScope position(b_, link.span.where, where_);
        if (const auto* cast = as_if<CastExpr>(&link)) {
            left = convert(e_, left, cast->to);
            if (factor) factor = convert(e_, *factor, cast->to);
            continue;
        }
        const auto& node = as<BinaryExpr>(link);
        if (node.op == Op::Multiply && is_summed(parts.links, i)) {
            factor = expr(*node.right);
            continue;
        }
        left = factor ? product_and(node, left, *factor) : operated(node, left);
        factor.reset();
    }
    return left;
}

// x * y + right, or x * y - right.
Lowered Expressions::product_and(const BinaryExpr& e, const Lowered& x, const Lowered& y) {
    Lowered z = expr(*e.right), r{e.type.base, {}};
    for (size_t c = 0; c < size_t(r.size()); ++c)
        r.c[c] = e_.fma(x.c[c], y.c[c], e.op == Op::Add ? z.c[c] : b_.neg(z.c[c]));
    return r;
}

Lowered Expressions::operated(const BinaryExpr& e, const Lowered& left) {
    if (e.op == Op::And || e.op == Op::Or) return logical(e, left.c[0]);
    bool sums = e.op == Op::Add || e.op == Op::Subtract;
    Lowered r = sums ? sum_of(e.op, left, *e.right) : binary(e_, e.op, left, expr(*e.right));
    if (is_triple(e.type.base) && is_triple(r.type)) r.type = e.type.base;
    return r;
}

// left + right or left - right, where right may be a product.
Lowered Expressions::sum_of(Op op, const Lowered& left, const Expr& right) {
    Lowered x, y;
    if (!as_product(right, left.type, x, y)) return binary(e_, op, left, expr(right));
    Lowered r = left;
    for (size_t c = 0; c < size_t(r.size()); ++c)
        r.c[c] = e_.fma(op == Op::Add ? x.c[c] : b_.neg(x.c[c]), y.c[c], left.c[c]);
    return r;
}

// Sides that call functions run only for their lanes; other sides are cheaper computed for all.
bool Expressions::runs_apart(std::initializer_list<const Expr*> sides, uint32_t effects) const {
    ChangeFinder finder(context_.ast());
    for (const Expr* side : sides) finder.add(side);
    const Changes& changes = finder.changes;
    return !changes.symbols.empty() || (changes.effects & effects) || changes.calls;
}

// && and ||: the right side is asked for where the left one does not tell.
Lowered Expressions::logical(const BinaryExpr& e, Value left) {
    bool asked_when = e.op == Op::And;
    bool known;
    if (b_.constant_m(left, &known))
        return known == asked_when ? expr(*e.right) : lowered(BaseType::Bool, left);
    if (!runs_apart({e.right}, kService | kLights | kTraces | kPrints)) {
        Value right = regions_.asking(left, asked_when, [&] { return value(*e.right); });
        return binary(e_, e.op, lowered(BaseType::Bool, left), lowered(BaseType::Bool, right));
    }
    int slot = slots_.add(lowered(BaseType::Bool, left));
    Value asked = asked_when ? b_.logical_and(e_.running, left) : b_.and_not(e_.running, left);
    regions_.guarded(asked, [&] { slots_.write(slot, lowered(BaseType::Bool, value(*e.right))); });
    slots_.kill(slot);
    return slots_.read(slot);
}

Lowered Expressions::select_expr(const SelectExpr& e) {
    Value condition = value(*e.condition);
    bool known;
    if (b_.constant_m(condition, &known)) return expr(known ? *e.yes : *e.no);
    Lowered r = zero(e_, e.type.base);
    if (!runs_apart({e.yes, e.no}, ~0u)) {
        Lowered yes = regions_.asking(condition, true, [&] { return expr(*e.yes); });
        Lowered no = regions_.asking(condition, false, [&] { return expr(*e.no); });
        for (size_t c = 0; c < size_t(r.size()); ++c)
            r.c[c] = b_.select(condition, yes.c[c], no.c[c]);
        return r;
    }
    int slot = slots_.add(r);
    Value before = e_.running;
    regions_.guarded(b_.logical_and(before, condition), [&] { slots_.write(slot, expr(*e.yes)); });
    regions_.guarded(b_.and_not(before, condition), [&] { slots_.write(slot, expr(*e.no)); });
    slots_.kill(slot);
    return slots_.read(slot);
}

Lowered Expressions::assign(const AssignExpr& e) {
    if (e.target->type.is_array()) {
        variables_.assign_array(*as<VariableExpr>(*e.target).symbol, *e.value);
        return zero(e_, e.target->type.base);
    }
    Lowered result;
    if (e.op == Op::None) {
        result = expr(*e.value);
        variables_.store(variables_.target(*e.target), result);
        return result;
    }
    LValue t = variables_.target(*e.target);
    Lowered before = variables_.load(t);  // a += b is a = a + b, from left to right
    bool sums = e.op == Op::Add || e.op == Op::Subtract;
    result = sums ? sum_of(e.op, before, *e.value) : binary(e_, e.op, before, expr(*e.value));
    variables_.store(t, result);
    return result;
}

}  // namespace kinora::rsl
