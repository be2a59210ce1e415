// rsl/check/shader_space.cpp: casts to "shader" space around defaults.
#include "rsl/check/shader_space.h"

namespace kinora::rsl {

namespace {

// A triple or number, perhaps with its sign.
bool is_written_out(const Expr& value) {
    if (value.kind == ExprKind::Unary) {
        const auto& unary = as<UnaryExpr>(value);
        return unary.op == Op::Negate && is_written_out(*unary.operand);
    }
    return value.kind == ExprKind::Triple || value.kind == ExprKind::Number;
}

void put_in_shader_space(Ast& ast, Expr*& value, BaseType base) {
    CastExpr* cast = value->kind == ExprKind::Cast ? &as<CastExpr>(*value) : nullptr;
    if (cast && (cast->space || !is_spatial(cast->to))) return;
    if (!is_written_out(*(cast ? cast->operand : value))) return;
    if (!cast) {
        cast = ast.make<CastExpr>(value->span);
        cast->to = base;
        cast->operand = value;
        value = cast;
    }
    auto* space = ast.make<StringExpr>(value->span);
    space->value = "shader";
    cast->space = space;
}

}  // namespace

void put_default_in_shader_space(Ast& ast, Symbol& symbol) {
    if (symbol.kind != SymbolKind::Parameter || !is_spatial(symbol.type.base)) return;
    if (!symbol.initial) return;
    if (symbol.initial->kind != ExprKind::ArrayLiteral)
        return put_in_shader_space(ast, symbol.initial, symbol.type.base);
    for (Expr*& item : as<ArrayLiteralExpr>(*symbol.initial).items)
        put_in_shader_space(ast, item, symbol.type.base);
}

}  // namespace kinora::rsl
