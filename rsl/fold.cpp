// rsl/fold.cpp: values of parameter defaults that need no running.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include "rsl/usage.h"

namespace kinora::rsl {

namespace {

using Numbers = std::vector<float>;

std::optional<Numbers> numbers(const Expr& expr) {
    std::optional<ConstantValue> value = fold_constant(expr);
    if (!value || !value->strings.empty() || value->in_shader_space) return {};
    return std::move(value->numbers);
}

std::optional<ConstantValue> of(Numbers values) {
    return ConstantValue{std::move(values), {}, false};
}

std::optional<ConstantValue> fold(const Expr&) {
    return {};
}
std::optional<ConstantValue> fold(const NumberExpr& e) {
    return of({float(e.value)});
}
std::optional<ConstantValue> fold(const StringExpr& e) {
    return ConstantValue{{}, {std::string(e.value)}, false};
}
std::optional<ConstantValue> fold(const VariableExpr& e) {
    bool pi = e.symbol && e.symbol->global && e.symbol->global->id == Global::PI;
    return pi ? of({3.14159265358979323846f}) : std::nullopt;
}
std::optional<ConstantValue> fold(const UnaryExpr& e) {
    auto value = e.op == Op::Negate ? numbers(*e.operand) : std::nullopt;
    if (!value) return {};
    for (float& x : *value) x = -x;
    return of(*std::move(value));
}

// Componentwise arithmetic; products of matrices are left to the compiler.
std::optional<ConstantValue> fold(const BinaryExpr& e) {
    if (e.type.base == BaseType::Matrix) return {};
    auto a = numbers(*e.left), b = numbers(*e.right);
    if (!a || !b || a->size() != b->size()) return {};
    for (size_t i = 0; i < a->size(); ++i) {
        float &x = (*a)[i], y = (*b)[i];
        switch (e.op) {
            case Op::Add:
                x += y;
                break;
            case Op::Subtract:
                x -= y;
                break;
            case Op::Multiply:
                x *= y;
                break;
            case Op::Divide:
                x = std::fabs(y) < FLT_MIN ? 0.0f
                                           : x / y;  // as shaders divide (EXTREMES.md row 47)
                break;
            default:
                return {};
        }
    }
    return of(*std::move(a));
}

std::optional<ConstantValue> fold_items(std::span<Expr* const> items) {
    ConstantValue all;
    for (const Expr* item : items) {
        std::optional<ConstantValue> value = fold_constant(*item);
        if (!value) return {};
        if (item == items[0]) all.in_shader_space = value->in_shader_space;
        if (value->in_shader_space != all.in_shader_space) return {};
        all.numbers.insert(all.numbers.end(), value->numbers.begin(), value->numbers.end());
        all.strings.insert(all.strings.end(), value->strings.begin(), value->strings.end());
    }
    return all;
}
std::optional<ConstantValue> fold(const TripleExpr& e) {
    return fold_items(e.items);
}
std::optional<ConstantValue> fold(const SixteenExpr& e) {
    return fold_items(e.items);
}
std::optional<ConstantValue> fold(const ArrayLiteralExpr& e) {
    std::optional<ConstantValue> all = fold_items(e.items);
    if (!all) return {};
    ConstantValue zero = zero_constant(e.type);
    all->numbers.resize(zero.numbers.size());
    all->strings.resize(zero.strings.size());
    return all;
}
std::optional<ConstantValue> in_shader_space(const CastExpr& e) {
    if (!is_spatial(e.to) || e.space->kind != ExprKind::String ||
        as<StringExpr>(*e.space).value != "shader")
        return {};
    std::optional<Numbers> values = numbers(*e.operand);
    if (!values) return {};
    if (values->size() == 1) values->resize(3, values->front());
    return ConstantValue{*std::move(values), {}, true};
}
std::optional<ConstantValue> fold(const CastExpr& e) {
    if (e.space) return in_shader_space(e);
    std::optional<ConstantValue> value = fold_constant(*e.operand);
    if (!value || e.operand->type.base == e.to) return value;
    if (e.operand->type.base != BaseType::Float)
        return is_triple(e.to) && value->numbers.size() == 3 ? value : std::nullopt;
    if (is_triple(e.to)) return of(Numbers(3, value->numbers[0]));
    if (e.to != BaseType::Matrix) return {};
    Numbers matrix(16, 0.0f);
    for (size_t i = 0; i < 16; i += 5) matrix[i] = value->numbers[0];
    return of(std::move(matrix));
}

}  // namespace

std::optional<ConstantValue> fold_constant(const Expr& expr) {
    return visit_expr(expr, [](const auto& node) { return fold(node); });
}

ConstantValue zero_constant(Type type) {
    size_t elements = size_t(type.is_array() ? type.array_length : 1);
    if (type.base == BaseType::String) return {{}, std::vector<std::string>(elements)};
    return {Numbers(elements * size_t(component_count(type.base)), 0.0f), {}};
}

}  // namespace kinora::rsl
