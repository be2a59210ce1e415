// rsl/lint/loops.cpp: loops that cannot end once they have begun.
#include <algorithm>

#include "rsl/lint/lint_p.h"
#include "rsl/model/builtin.h"
#include "rsl/reference/reference.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

namespace {

// What a condition depends on; `known`: on variables alone.
struct Condition {
    std::vector<const Symbol*> symbols;
    bool known = true;
};

Condition condition_of(const Expr& expr) {
    Condition condition;
    for_each_expr_below(expr, [&](const Expr& part) {
        if (auto* variable = as_if<VariableExpr>(&part))
            condition.symbols.push_back(variable->symbol);
        auto* call = as_if<CallExpr>(&part);
        if (part.kind == ExprKind::Assign || (call && !call->builtin)) condition.known = false;
        if (call && call->builtin && call->builtin->effects != kPure) condition.known = false;
    });
    return condition;
}

bool is_never(const Expr& condition) {
    std::optional<ConstantValue> value = evaluate_constant(condition);
    return value && value->numbers.size() == 1 && value->numbers[0] == 0;
}

bool cannot_end(const LintSource& source, const Expr* condition, const Stmt& body,
                std::span<Expr* const> step) {
    ChangeFinder finder(source.ast);
    finder.add(&body);
    for (const Expr* e : step) finder.add(e);
    const Changes& changes = finder.changes;
    if (changes.returns || !changes.breaks.empty()) return false;
    if (!condition) return true;
    Condition needs = condition_of(*condition);
    if (!needs.known || (needs.symbols.empty() && is_never(*condition))) return false;
    return std::none_of(needs.symbols.begin(), needs.symbols.end(), [&](const Symbol* symbol) {
        return std::find(changes.symbols.begin(), changes.symbols.end(), symbol) !=
               changes.symbols.end();
    });
}

}  // namespace

std::optional<double> number_of(const Expr& expr) {
    Condition needs = condition_of(expr);
    if (!needs.known || !needs.symbols.empty()) return {};
    std::optional<ConstantValue> value = evaluate_constant(expr);
    if (!value || value->numbers.size() != 1) return {};
    return value->numbers[0];
}

namespace {

// What a step adds to the variable: "i += 2", "i = i - 1". None where it is not a constant.
std::optional<double> added_by(const Expr& step, const Symbol* symbol) {
    auto is_it = [&](const Expr* e) {
        auto* variable = as_if<VariableExpr>(e);
        return variable && variable->symbol == symbol;
    };
    auto* assign = as_if<AssignExpr>(&step);
    if (!assign || !is_it(assign->target)) return {};
    auto* sum = assign->op == Op::None ? as_if<BinaryExpr>(assign->value) : nullptr;
    if (assign->op == Op::None && (!sum || !is_it(sum->left))) return {};
    Op op = sum ? sum->op : assign->op;
    if (op != Op::Add && op != Op::Subtract) return {};
    std::optional<double> value = number_of(sum ? *sum->right : *assign->value);
    if (!value) return {};
    return op == Op::Add ? *value : -*value;
}

// "for (i = 0; i < 10; i -= 1)": the variable that a bound ends goes the other way, by the step
// alone.
bool leads_away(const LintSource& source, const ForStmt& loop) {
    auto* compared = as_if<BinaryExpr>(loop.condition);
    if (!compared || loop.step.size() != 1) return false;
    bool below = compared->op == Op::Less || compared->op == Op::LessEqual;
    if (!below && compared->op != Op::Greater && compared->op != Op::GreaterEqual) return false;
    auto* variable = as_if<VariableExpr>(compared->left);
    if (!variable || !number_of(*compared->right)) return false;
    ChangeFinder body(source.ast);
    body.add(loop.body);
    const Changes& changes = body.changes;
    if (changes.returns || !changes.breaks.empty()) return false;
    if (std::find(changes.symbols.begin(), changes.symbols.end(), variable->symbol) !=
        changes.symbols.end())
        return false;
    std::optional<double> added = added_by(*loop.step[0], variable->symbol);
    return added && (below ? *added < 0 : *added > 0);
}

}  // namespace

void lint_loops(LintSource& source) {
    for_each_node(
        source, [](const Expr&) {},
        [&](const Stmt& stmt) {
            auto* loop = as_if<WhileStmt>(&stmt);
            auto* counted = as_if<ForStmt>(&stmt);
            bool endless =
                (loop && cannot_end(source, loop->condition, *loop->body, {})) ||
                (counted && cannot_end(source, counted->condition, *counted->body, counted->step));
            if (endless && source.is_own(stmt.span))
                source.reporter.report(Code::RSL_ENDLESS_LOOP, stmt.span);
            else if (counted && source.is_own(stmt.span) && leads_away(source, *counted))
                source.reporter.report(Code::RSL_LOOP_AWAY, stmt.span);
        });
}

}  // namespace kinora::rsl
