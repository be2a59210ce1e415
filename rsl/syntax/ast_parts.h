// rsl/syntax/ast_parts.h: what a node of the tree holds.
#pragma once

#include "rsl/syntax/chain.h"

namespace kinora::rsl {

// Calls f for each operand of `expr`, in the order of evaluation. The operands of a chain of
// operators are the leftmost and those at the right of each: what links them is none.
template <class ExprRef, class F>
void for_each_operand(ExprRef& expr, F&& f) {
    switch (expr.kind) {
        case ExprKind::Number:
        case ExprKind::String:
        case ExprKind::Variable:
            return;
        case ExprKind::Index:
            f(as<IndexExpr>(expr).array), f(as<IndexExpr>(expr).index);
            return;
        case ExprKind::Component:
            f(as<ComponentExpr>(expr).operand), f(as<ComponentExpr>(expr).index);
            return;
        case ExprKind::Unary:
            f(as<UnaryExpr>(expr).operand);
            return;
        case ExprKind::Binary: {
            auto chain = chain_of(expr);
            f(*left_in_chain(*chain.links[0]));
            for (auto* link : chain.links)
                if (auto* node = as_if<BinaryExpr>(link)) f(node->right);
            return;
        }
        case ExprKind::Select:
            f(as<SelectExpr>(expr).condition), f(as<SelectExpr>(expr).yes);
            f(as<SelectExpr>(expr).no);
            return;
        case ExprKind::Assign:
            f(as<AssignExpr>(expr).value), f(as<AssignExpr>(expr).target);
            return;
        case ExprKind::Call:
            for (Expr* arg : as<CallExpr>(expr).args) f(arg);
            if (as<CallExpr>(expr).channel) f(as<CallExpr>(expr).channel);
            return;
        case ExprKind::Cast:
            if (as<CastExpr>(expr).space) f(as<CastExpr>(expr).space);
            f(as<CastExpr>(expr).operand);
            return;
        case ExprKind::Triple:
            for (Expr* item : as<TripleExpr>(expr).items) f(item);
            return;
        case ExprKind::Sixteen:
            for (Expr* item : as<SixteenExpr>(expr).items) f(item);
            return;
        case ExprKind::ArrayLiteral:
            for (Expr* item : as<ArrayLiteralExpr>(expr).items) f(item);
            return;
    }
}

// Calls on_expr and on_stmt for the direct parts of `stmt`; parts that are absent are skipped. The
// body of a function that it defines is none.
template <class StmtRef, class OnExpr, class OnStmt>
void for_each_part(StmtRef& stmt, OnExpr&& on_expr, OnStmt&& on_stmt) {
    auto e = [&](Expr* expr) {
        if (expr) on_expr(expr);
    };
    auto s = [&](Stmt* part) {
        if (part) on_stmt(part);
    };
    switch (stmt.kind) {
        case StmtKind::Block:
            for (Stmt* part : as<BlockStmt>(stmt).body) s(part);
            return;
        case StmtKind::Declare:
            for (const Symbol* symbol : as<DeclareStmt>(stmt).symbols)
                e(symbol->length), e(symbol->initial);
            return;
        case StmtKind::Extern:
        case StmtKind::DefineFunction:
        case StmtKind::Break:
        case StmtKind::Continue:
            return;
        case StmtKind::Expression:
            e(as<ExpressionStmt>(stmt).expression);
            return;
        case StmtKind::If: {
            auto& node = as<IfStmt>(stmt);
            e(node.condition), s(node.yes), s(node.no);
            return;
        }
        case StmtKind::While: {
            auto& node = as<WhileStmt>(stmt);
            e(node.condition), s(node.body);
            return;
        }
        case StmtKind::For: {
            auto& node = as<ForStmt>(stmt);
            for (Stmt* part : node.init) s(part);
            e(node.condition);
            for (Expr* part : node.step) e(part);
            s(node.body);
            return;
        }
        case StmtKind::Return:
            e(as<ReturnStmt>(stmt).value);
            return;
        case StmtKind::Illuminance: {
            auto& node = as<IlluminanceStmt>(stmt);
            e(node.category), e(node.position), e(node.axis), e(node.angle);
            for (Expr* part : node.pairs) e(part);
            s(node.body);
            return;
        }
        case StmtKind::Illuminate: {
            auto& node = as<IlluminateStmt>(stmt);
            e(node.position), e(node.axis), e(node.angle), s(node.body);
            return;
        }
        case StmtKind::Solar: {
            auto& node = as<SolarStmt>(stmt);
            e(node.axis), e(node.angle), s(node.body);
            return;
        }
        case StmtKind::Gather: {
            auto& node = as<GatherStmt>(stmt);
            for (Expr* part : node.args) e(part);
            s(node.body), s(node.missed);
            return;
        }
    }
}

}  // namespace kinora::rsl
