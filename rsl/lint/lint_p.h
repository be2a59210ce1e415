// rsl/lint/lint_p.h: what the checks of rsl/lint share.
#pragma once

#include <optional>

#include "rsl/check/tree_reporter.h"
#include "rsl/lint/lint.h"
#include "rsl/model/changes.h"

namespace kinora::rsl {

// One source that is looked at.
struct LintSource {
    const Ast& ast;
    std::span<const std::unique_ptr<Shader>> shaders;
    const LintOptions& options;
    TreeReporter reporter;

    // Written in the source itself: not in a header, and not by a macro.
    bool is_own(const SourceSpan& span) const {
        bool here = options.file == kNoFile || span.where.file == options.file;
        return here && ast.tokens.tokens[span.token].macro == 0;
    }
};

// Calls on_expr and on_stmt with each node below, itself first. Nested functions are not entered.
template <class OnExpr>
void for_each_expr_below(const Expr& expr, OnExpr&& on_expr) {
    on_expr(expr);
    for_each_operand(expr, [&](const Expr* part) { for_each_expr_below(*part, on_expr); });
}
template <class OnExpr, class OnStmt>
void for_each_below(const Stmt& stmt, OnExpr&& on_expr, OnStmt&& on_stmt) {
    on_stmt(stmt);
    for_each_part(
        stmt, [&](const Expr* part) { for_each_expr_below(*part, on_expr); },
        [&](const Stmt* part) { for_each_below(*part, on_expr, on_stmt); });
}

// The same for the source: shaders' bodies, functions and those nested in them.
template <class OnExpr, class OnStmt>
void for_each_node(const LintSource& source, OnExpr&& on_expr, OnStmt&& on_stmt) {
    auto body = [&](auto& self, const Stmt& stmt) -> void {
        for_each_below(stmt, on_expr, [&](const Stmt& part) {
            on_stmt(part);
            if (auto* nested = as_if<FunctionStmt>(&part)) self(self, *nested->function->body);
        });
    };
    for (const Function* f : source.ast.functions) body(body, *f->body);
    for (const ShaderDefinition* shader : source.ast.shaders) {
        for (const Symbol* p : shader->parameters)
            if (p->initial) for_each_expr_below(*p->initial, on_expr);
        body(body, *shader->body);
    }
}

// The value of an expression that depends on nothing.
std::optional<double> number_of(const Expr& expr);

void lint_indices(LintSource& source);   // constant ones outside of their arrays
void lint_names(LintSource& source);     // unused, unset and hiding ones
void lint_loops(LintSource& source);     // that cannot end
void lint_textures(LintSource& source);  // whose files are missing

}  // namespace kinora::rsl
