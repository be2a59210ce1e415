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
        });
}

}  // namespace kinora::rsl
