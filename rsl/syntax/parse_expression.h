// rsl/syntax/parse_expression.h: expressions, by precedence climbing.
#pragma once

#include <span>

#include "rsl/syntax/ast.h"
#include "rsl/syntax/nesting.h"
#include "rsl/syntax/parse_foreign.h"
#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

inline constexpr int kMostHeight = 400;  // of an expression's tree, which later passes walk
inline constexpr int kMostArrayLength = 1 << 20;

class ExpressionParser {
  public:
    ExpressionParser(Ast& ast, TokenCursor& cursor, SyntaxErrors& errors, ForeignSyntax& foreign,
                     Nesting& nesting)
        : ast_(ast), cursor_(cursor), errors_(errors), foreign_(foreign), nesting_(nesting) {}

    // In panic there is a node too, which means nothing.
    Expr* expression();
    Expr* unary();
    Expr* number();
    // "a, b, c" and the closing token; without `expected`, of arguments.
    std::span<Expr*> expression_list(Punct end, const char* expected);
    // The same between parentheses.
    std::span<Expr*> arguments();

  private:
    Expr* ternary();
    Expr* binary(int lowest);
    bool at_doubled_sign() const;
    Expr* negated(int lowest);
    Expr* cast();
    Expr* c_cast();
    Expr* postfix();
    Expr* member(Expr* operand);
    Expr* primary();
    Expr* string();
    Expr* parenthesised();
    Expr* call();
    Expr* bad_expression();
    void grow(int part_height);
    void too_deep();

    template <class Node>
    Node* make(SourceSpan span) {
        return ast_.make<Node>(span);
    }

    Ast& ast_;
    TokenCursor& cursor_;
    SyntaxErrors& errors_;
    ForeignSyntax& foreign_;
    Nesting& nesting_;
    int height_ = 0;  // of the expression parsed last
};

// The value of a constant whole-number expression (array lengths); -1 when it is none.
long constant_length(const Expr& expr);

}  // namespace kinora::rsl
