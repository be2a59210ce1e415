// rsl/check_convert.cpp: implicit conversions, and expressions whose type the context chooses.
#include <algorithm>

#include "rsl/check.h"

namespace kinora::rsl {

// Real shaders mix points, vectors, normals and colors freely, and so do both peers (RSL.md).
int conversion_cost(BaseType from, BaseType to) {
    if (from == to) return 0;
    if (from == BaseType::Bool) {
        int rest = to == BaseType::Bool ? 0 : conversion_cost(BaseType::Float, to);
        return rest < 0 ? -1 : rest + 1;
    }
    if (from == BaseType::Float)
        return to == BaseType::Color ? 3 : is_triple(to) ? 4 : to == BaseType::Matrix ? 6 : -1;
    if (!is_triple(from) || !is_triple(to)) return -1;
    return is_spatial(from) && is_spatial(to) ? 1 : 2;
}

// Puts casts around the expression; false when there is no conversion.
bool Checker::convert(Expr*& slot, BaseType to) {
    if (slot->type.base == to && !slot->type.is_array()) return true;
    if (slot->type.is_array() || conversion_cost(slot->type.base, to) < 0) return false;
    if (slot->type.base == BaseType::Bool && to != BaseType::Float) convert(slot, BaseType::Float);
    auto* cast = ast_.make<CastExpr>(slot->place);
    cast->to = to;
    cast->implicit = true;
    cast->operand = slot;
    cast->type = {to, -1};
    slot = cast;
    return true;
}

// Whether the context may choose the type of the unchecked expression: a (x, y, z), a call of a
// built-in with several result types, or an operator on such.
bool Checker::is_flexible(const Expr& expr) const {
    switch (expr.kind) {
        case ExprKind::Triple:
            return true;
        case ExprKind::Unary:
            return is_flexible(*as<UnaryExpr>(expr).operand);
        case ExprKind::Binary: {
            const auto& e = as<BinaryExpr>(expr);
            bool arithmetic = e.op >= Op::Add && e.op <= Op::Divide;
            return arithmetic && (is_flexible(*e.left) || is_flexible(*e.right));
        }
        case ExprKind::Select: {
            const auto& e = as<SelectExpr>(expr);
            return is_flexible(*e.yes) || is_flexible(*e.no);
        }
        case ExprKind::Call: {
            const auto& e = as<CallExpr>(expr);
            if (!visible_functions(e.name).empty()) return false;
            std::span<const Overload> overloads = find_builtin(e.name);
            return std::any_of(overloads.begin(), overloads.end(), [&](const Overload& o) {
                return o.signature.result != overloads[0].signature.result;
            });
        }
        default:
            return false;
    }
}

// Whether a flexible expression can have exactly this type.
bool Checker::can_be(const Expr& expr, BaseType type) const {
    if (!is_flexible(expr)) return conversion_cost(expr.type.base, type) == 0;
    switch (expr.kind) {
        case ExprKind::Triple:
            return is_triple(type);
        case ExprKind::Unary:
            return can_be(*as<UnaryExpr>(expr).operand, type);
        case ExprKind::Binary: {
            const auto& e = as<BinaryExpr>(expr);
            bool left = is_flexible(*e.left), right = is_flexible(*e.right);
            return (!left || can_be(*e.left, type)) && (!right || can_be(*e.right, type));
        }
        case ExprKind::Select: {
            const auto& e = as<SelectExpr>(expr);
            bool yes = is_flexible(*e.yes), no = is_flexible(*e.no);
            return (!yes || can_be(*e.yes, type)) && (!no || can_be(*e.no, type));
        }
        case ExprKind::Call: {
            std::span<const Overload> overloads = find_builtin(as<CallExpr>(expr).name);
            return std::any_of(overloads.begin(), overloads.end(),
                               [&](const Overload& o) { return o.signature.result.base == type; });
        }
        default:
            return false;
    }
}

// Whether a flexible expression shows a picture: beside a color those are colors, where noise()
// is a factor.
bool Checker::is_picture(const Expr& expr) const {
    switch (expr.kind) {
        case ExprKind::Unary:
            return is_picture(*as<UnaryExpr>(expr).operand);
        case ExprKind::Binary:
            return is_picture(*as<BinaryExpr>(expr).left) ||
                   is_picture(*as<BinaryExpr>(expr).right);
        case ExprKind::Select:
            return is_picture(*as<SelectExpr>(expr).yes) || is_picture(*as<SelectExpr>(expr).no);
        case ExprKind::Call: {
            std::string_view name = as<CallExpr>(expr).name;
            return name == "texture" || name == "environment" || name == "trace";
        }
        default:
            return false;
    }
}

}  // namespace kinora::rsl
