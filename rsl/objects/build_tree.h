// rsl/objects/build_tree.h: new nodes of an unchecked tree.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Makes nodes that stand where `span` says.
class TreeBuilder {
  public:
    TreeBuilder(Ast& ast, SourceSpan span) : ast_(ast), span_(span) {}

    Expr* variable(std::string_view name);
    Expr* number(double value);
    Expr* text(std::string_view value);
    // With a copy of the index; `nodes` grows by its size.
    Expr* element(std::string_view array, const Expr& index, size_t* nodes);
    Expr* binary(Op op, Expr* left, Expr* right);
    Expr* cast(BaseType to, Expr* operand);
    Expr* call(std::string_view name, std::vector<Expr*> args);
    Stmt* assign(Expr* target, Expr* value);
    Stmt* effect(Expr* expression);
    IfStmt* branch(Expr* condition, std::vector<Stmt*> body);
    BlockStmt* block(std::vector<Stmt*> body);
    Stmt* declare(std::vector<Symbol*> symbols);
    Symbol* symbol(SymbolKind kind, std::string_view name, Type type);

  private:
    Ast& ast_;
    SourceSpan span_;
};

}  // namespace kinora::rsl
