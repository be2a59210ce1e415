// rsl/check/convert.cpp: which types convert to which.
#include "rsl/check/convert.h"

namespace kinora::rsl {

// Real shaders mix points, vectors, normals and colors freely
// (docs/language.md#types-and-conversions).
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

const char* conversion_help(BaseType from, BaseType to) {
    bool to_float = to == BaseType::Float, to_string = to == BaseType::String;
    if (to_float && from == BaseType::Color) return "take a component: comp(c, 0), or c[0]";
    if (to_float && is_triple(from)) return "take a component, as xcomp(p), or length(v)";
    if (to_float && from == BaseType::Matrix) return "take an element: comp(m, row, column)";
    if (to_string && from != BaseType::Void) return "use format(\"%f\", x)";
    if (to == BaseType::Matrix && is_triple(from)) return "use translate(1, v) or scale(1, v)";
    return "";
}

BaseType common_type(BaseType a, BaseType b) {
    if (a == BaseType::Bool) a = BaseType::Float;
    if (b == BaseType::Bool) b = BaseType::Float;
    if (a == b) return a;
    if (a == BaseType::Float) return is_numeric(b) ? b : BaseType::Invalid;
    if (b == BaseType::Float) return is_numeric(a) ? a : BaseType::Invalid;
    if (!is_triple(a) || !is_triple(b)) return BaseType::Invalid;
    if (a == BaseType::Color || b == BaseType::Color) return BaseType::Color;
    if (a == BaseType::Point || b == BaseType::Point) return BaseType::Point;
    return BaseType::Vector;
}

void convert_to_condition(Ast& ast, Expr*& slot) {
    auto* cast = ast.make<CastExpr>(slot->span);
    cast->to = BaseType::Bool;
    cast->implicit = true;
    cast->operand = slot;
    cast->type = {BaseType::Bool, -1};
    slot = cast;
}

bool convert(Ast& ast, Expr*& slot, BaseType to) {
    if (slot->type.base == to && !slot->type.is_array()) return true;
    if (slot->type.is_array() || conversion_cost(slot->type.base, to) < 0) return false;
    if (slot->type.base == BaseType::Bool && to != BaseType::Float)
        convert(ast, slot, BaseType::Float);
    auto* cast = ast.make<CastExpr>(slot->span);
    cast->to = to;
    cast->implicit = true;
    cast->operand = slot;
    cast->type = {to, -1};
    slot = cast;
    return true;
}

}  // namespace kinora::rsl
