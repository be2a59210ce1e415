// rsl/objects/tree_parts.cpp: what a node of the unchecked tree holds.
#include "rsl/objects/tree_parts.h"

#include "rsl/syntax/ast_parts.h"
#include "rsl/syntax/ast_visit.h"

namespace kinora::rsl {

namespace {

using Exprs = std::vector<Expr*>;
using Stmts = std::vector<Stmt*>;

Exprs list(std::span<Expr* const> items) {
    return {items.begin(), items.end()};
}

struct Operands {
    Exprs operator()(const NumberExpr&) { return {}; }
    Exprs operator()(const StringExpr&) { return {}; }
    Exprs operator()(const VariableExpr&) { return {}; }
    Exprs operator()(const IndexExpr& e) { return {e.array, e.index}; }
    Exprs operator()(const ComponentExpr& e) { return {e.operand, e.index}; }
    Exprs operator()(const UnaryExpr& e) { return {e.operand}; }
    Exprs operator()(const BinaryExpr& e) {
        Exprs parts;
        for_each_operand(static_cast<const Expr&>(e), [&](Expr* part) { parts.push_back(part); });
        return parts;
    }
    Exprs operator()(const SelectExpr& e) { return {e.condition, e.yes, e.no}; }
    Exprs operator()(const AssignExpr& e) { return {e.target, e.value}; }
    Exprs operator()(const CallExpr& e) {
        Exprs parts = list(e.args);
        parts.push_back(e.channel);
        return parts;
    }
    Exprs operator()(const CastExpr& e) { return {e.space, e.operand}; }
    Exprs operator()(const TripleExpr& e) { return list(e.items); }
    Exprs operator()(const SixteenExpr& e) { return list(e.items); }
    Exprs operator()(const ArrayLiteralExpr& e) { return list(e.items); }
};

struct Expressions {
    Exprs operator()(const BlockStmt&) { return {}; }
    Exprs operator()(const DeclareStmt& s) {
        Exprs parts;
        for (const Symbol* symbol : s.symbols) {
            parts.push_back(symbol->initial);
            parts.push_back(symbol->length);
        }
        return parts;
    }
    Exprs operator()(const ExternStmt&) { return {}; }
    Exprs operator()(const FunctionStmt&) { return {}; }
    Exprs operator()(const ExpressionStmt& s) { return {s.expression}; }
    Exprs operator()(const IfStmt& s) { return {s.condition}; }
    Exprs operator()(const WhileStmt& s) { return {s.condition}; }
    Exprs operator()(const ForStmt& s) {
        Exprs parts = list(s.step);
        parts.push_back(s.condition);
        return parts;
    }
    Exprs operator()(const BreakStmt&) { return {}; }
    Exprs operator()(const ContinueStmt&) { return {}; }
    Exprs operator()(const ReturnStmt& s) { return {s.value}; }
    Exprs operator()(const IlluminanceStmt& s) { return list(s.args); }
    Exprs operator()(const IlluminateStmt& s) { return {s.position, s.axis, s.angle}; }
    Exprs operator()(const SolarStmt& s) { return {s.axis, s.angle}; }
    Exprs operator()(const GatherStmt& s) { return list(s.args); }
};

struct Statements {
    Stmts operator()(const BlockStmt& s) { return {s.body.begin(), s.body.end()}; }
    Stmts operator()(const DeclareStmt&) { return {}; }
    Stmts operator()(const ExternStmt&) { return {}; }
    Stmts operator()(const FunctionStmt&) { return {}; }
    Stmts operator()(const ExpressionStmt&) { return {}; }
    Stmts operator()(const IfStmt& s) { return {s.yes, s.no}; }
    Stmts operator()(const WhileStmt& s) { return {s.body}; }
    Stmts operator()(const ForStmt& s) {
        Stmts parts(s.init.begin(), s.init.end());
        parts.push_back(s.body);
        return parts;
    }
    Stmts operator()(const BreakStmt&) { return {}; }
    Stmts operator()(const ContinueStmt&) { return {}; }
    Stmts operator()(const ReturnStmt&) { return {}; }
    Stmts operator()(const IlluminanceStmt& s) { return {s.body}; }
    Stmts operator()(const IlluminateStmt& s) { return {s.body}; }
    Stmts operator()(const SolarStmt& s) { return {s.body}; }
    Stmts operator()(const GatherStmt& s) { return {s.body, s.missed}; }
};

template <class Parts>
Parts without_null(Parts parts) {
    std::erase(parts, nullptr);
    return parts;
}

}  // namespace

std::vector<Expr*> operands_of(const Expr& e) {
    return without_null(visit_expr(e, Operands()));
}
std::vector<Expr*> expressions_of(const Stmt& stmt) {
    return without_null(visit_stmt(stmt, Expressions()));
}
std::vector<Stmt*> statements_of(const Stmt& stmt) {
    return without_null(visit_stmt(stmt, Statements()));
}

}  // namespace kinora::rsl
