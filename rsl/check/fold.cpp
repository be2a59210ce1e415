// rsl/check/fold.cpp: values of parameter defaults that need no running.
#include <algorithm>

#include "rsl/check/usage.h"
#include "rsl/model/builtin.h"
#include "rsl/model/changes.h"
#include "rsl/reference/reference.h"
#include "rsl/syntax/ast_visit.h"

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

// What messages and queries may know before a kernel runs: no geometry, whose numbers depend on the
// space they are asked from.
bool is_plain(Type type) {
    return !type.is_array() && (type.base == BaseType::Float || type.base == BaseType::Color ||
                                type.base == BaseType::String || type.base == BaseType::Bool);
}

bool is_computed(const CallExpr& e) {
    auto plain = [](const Expr* argument) { return is_plain(argument->type); };
    return e.builtin && e.builtin->effects == kPure && !e.channel && is_plain(e.type) &&
           std::all_of(e.args.begin(), e.args.end(), plain);
}

// Does the value follow from the expression alone?
bool is_closed(const Expr& e) {
    bool closed = true;
    if (auto* variable = as_if<VariableExpr>(&e))
        closed = variable->symbol->global && variable->symbol->global->id == Global::PI;
    else if (auto* call = as_if<CallExpr>(&e))
        closed = is_computed(*call);
    else if (auto* cast = as_if<CastExpr>(&e))
        closed = !cast->space || cast->to == BaseType::Color;
    else
        closed = e.kind != ExprKind::Assign && e.kind != ExprKind::Index &&
                 e.kind != ExprKind::ArrayLiteral;
    for_each_operand(e, [&](const Expr* operand) { closed = closed && is_closed(*operand); });
    return closed;
}

std::optional<ConstantValue> fold(const Expr& e) {
    return is_closed(e) ? evaluate_constant(e) : std::nullopt;
}
std::optional<ConstantValue> fold(const NumberExpr& e) {
    return of({float(e.value)});
}
std::optional<ConstantValue> fold(const StringExpr& e) {
    return ConstantValue{{}, {std::string(e.value)}, false};
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
    if (e.space && e.to == BaseType::Color) return fold(static_cast<const Expr&>(e));
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
