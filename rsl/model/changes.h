// rsl/model/changes.h: what lowering must know of a piece of source before it writes code for it.
#pragma once

#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// What a statement or expression may change or do, functions it calls included. A loop carries just
// these.
struct Changes {
    std::vector<const Symbol*> symbols;      // written, each once
    std::vector<const Stmt*> breaks;         // loops that a break leaves
    std::vector<const Stmt*> continues;      // loops that a continue goes on with
    std::vector<const Stmt*> light_sources;  // illuminate and solar statements
    bool returns = false;                    // from the function it stands in
    bool random = false;                     // calls random()
    bool calls = false;                      // calls functions of the source
    uint32_t effects = 0;                    // Effects of all built-ins called, joined
};

// Collects the changes of any number of nodes.
class ChangeFinder {
  public:
    explicit ChangeFinder(const Ast& ast)
        : seen_symbols_(ast.symbol_count), seen_functions_(ast.function_count) {}
    void add(const Stmt* stmt);  // null is allowed
    void add(const Expr* expr);
    void add(const Function& body);

    Changes changes;
    std::vector<const Symbol*> used;  // every variable named, each once

  private:
    void written(const Expr* target);
    void note_use(const Symbol* symbol);
    std::vector<uint8_t> seen_symbols_;  // bit 0 used, bit 1 written
    std::vector<uint8_t> seen_functions_;
};

// Arrays that must lie in memory, by Symbol::id: indexed by something not constant, or long.
// Functions pass arrays by reference, so what one indexes marks what its callers hand it.
std::vector<uint8_t> memory_arrays(const Ast& ast);

// How many elements resizable arrays have room for, by Symbol::id: what resize() and reserve() ask
// for by numbers, or a customary count.
std::vector<int> array_capacities(const Ast& ast);

// Calls f(const Expr*) for each operand of `expr`, in the order of evaluation.
template <class F>
void for_each_operand(const Expr& expr, F&& f) {
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
        case ExprKind::Binary:
            f(as<BinaryExpr>(expr).left), f(as<BinaryExpr>(expr).right);
            return;
        case ExprKind::Select:
            f(as<SelectExpr>(expr).condition), f(as<SelectExpr>(expr).yes);
            f(as<SelectExpr>(expr).no);
            return;
        case ExprKind::Assign:
            f(as<AssignExpr>(expr).value), f(as<AssignExpr>(expr).target);
            return;
        case ExprKind::Call:
            for (const Expr* arg : as<CallExpr>(expr).args) f(arg);
            if (as<CallExpr>(expr).channel) f(as<CallExpr>(expr).channel);
            return;
        case ExprKind::Cast:
            if (as<CastExpr>(expr).space) f(as<CastExpr>(expr).space);
            f(as<CastExpr>(expr).operand);
            return;
        case ExprKind::Triple:
            for (const Expr* item : as<TripleExpr>(expr).items) f(item);
            return;
        case ExprKind::Sixteen:
            for (const Expr* item : as<SixteenExpr>(expr).items) f(item);
            return;
        case ExprKind::ArrayLiteral:
            for (const Expr* item : as<ArrayLiteralExpr>(expr).items) f(item);
            return;
    }
}

// Calls on_expr(const Expr*) and on_stmt(const Stmt*) for the direct parts of `stmt`; parts that
// are absent are skipped.
template <class OnExpr, class OnStmt>
void for_each_part(const Stmt& stmt, OnExpr&& on_expr, OnStmt&& on_stmt) {
    auto e = [&](const Expr* expr) {
        if (expr) on_expr(expr);
    };
    auto s = [&](const Stmt* part) {
        if (part) on_stmt(part);
    };
    switch (stmt.kind) {
        case StmtKind::Block:
            for (const Stmt* part : as<BlockStmt>(stmt).body) s(part);
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
            for (const Stmt* part : node.init) s(part);
            e(node.condition);
            for (const Expr* part : node.step) e(part);
            s(node.body);
            return;
        }
        case StmtKind::Return:
            e(as<ReturnStmt>(stmt).value);
            return;
        case StmtKind::Illuminance: {
            auto& node = as<IlluminanceStmt>(stmt);
            e(node.category), e(node.position), e(node.axis), e(node.angle);
            for (const Expr* part : node.pairs) e(part);
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
            for (const Expr* part : node.args) e(part);
            s(node.body), s(node.missed);
            return;
        }
    }
}

}  // namespace kinora::rsl
