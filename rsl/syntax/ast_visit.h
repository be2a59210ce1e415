// rsl/syntax/ast_visit.h: a node of the tree as its own type.
#pragma once

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Calls f with the expression as its own node type: f is overloaded on `NumberExpr&`, ... (const if
// `expr` is). All calls must return the same type.
template <class ExprRef, class F>
decltype(auto) visit_expr(ExprRef& expr, F&& f) {
    switch (expr.kind) {
        case ExprKind::Number:
            return f(as<NumberExpr>(expr));
        case ExprKind::String:
            return f(as<StringExpr>(expr));
        case ExprKind::Variable:
            return f(as<VariableExpr>(expr));
        case ExprKind::Index:
            return f(as<IndexExpr>(expr));
        case ExprKind::Component:
            return f(as<ComponentExpr>(expr));
        case ExprKind::Unary:
            return f(as<UnaryExpr>(expr));
        case ExprKind::Binary:
            return f(as<BinaryExpr>(expr));
        case ExprKind::Select:
            return f(as<SelectExpr>(expr));
        case ExprKind::Assign:
            return f(as<AssignExpr>(expr));
        case ExprKind::Call:
            return f(as<CallExpr>(expr));
        case ExprKind::Cast:
            return f(as<CastExpr>(expr));
        case ExprKind::Triple:
            return f(as<TripleExpr>(expr));
        case ExprKind::Sixteen:
            return f(as<SixteenExpr>(expr));
        case ExprKind::ArrayLiteral:
            break;
    }
    return f(as<ArrayLiteralExpr>(expr));
}

template <class StmtRef, class F>
decltype(auto) visit_stmt(StmtRef& stmt, F&& f) {
    switch (stmt.kind) {
        case StmtKind::Block:
            return f(as<BlockStmt>(stmt));
        case StmtKind::Declare:
            return f(as<DeclareStmt>(stmt));
        case StmtKind::Extern:
            return f(as<ExternStmt>(stmt));
        case StmtKind::DefineFunction:
            return f(as<FunctionStmt>(stmt));
        case StmtKind::Expression:
            return f(as<ExpressionStmt>(stmt));
        case StmtKind::If:
            return f(as<IfStmt>(stmt));
        case StmtKind::While:
            return f(as<WhileStmt>(stmt));
        case StmtKind::For:
            return f(as<ForStmt>(stmt));
        case StmtKind::Break:
            return f(as<BreakStmt>(stmt));
        case StmtKind::Continue:
            return f(as<ContinueStmt>(stmt));
        case StmtKind::Return:
            return f(as<ReturnStmt>(stmt));
        case StmtKind::Illuminance:
            return f(as<IlluminanceStmt>(stmt));
        case StmtKind::Illuminate:
            return f(as<IlluminateStmt>(stmt));
        case StmtKind::Solar:
            return f(as<SolarStmt>(stmt));
        case StmtKind::Gather:
            break;
    }
    return f(as<GatherStmt>(stmt));
}

}  // namespace kinora::rsl
