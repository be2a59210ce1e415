// rsl/syntax/parse_statement.h: statements, and functions, which may stand among them.
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "rsl/syntax/ast.h"
#include "rsl/syntax/nesting.h"
#include "rsl/syntax/open_definition.h"
#include "rsl/syntax/parse_declaration.h"
#include "rsl/syntax/parse_expression.h"
#include "rsl/syntax/parse_foreign.h"
#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

class StatementParser {
  public:
    StatementParser(Ast& ast, TokenCursor& cursor, SyntaxErrors& errors, ForeignSyntax& foreign,
                    Nesting& nesting, OpenDefinition& definition, ExpressionParser& expressions,
                    DeclarationParser& declarations)
        : ast_(ast),
          cursor_(cursor),
          errors_(errors),
          foreign_(foreign),
          nesting_(nesting),
          definition_(definition),
          expressions_(expressions),
          declarations_(declarations) {}

    // What reads a struct that is defined among statements.
    void read_structs_by(std::function<void()> reader) { local_struct_ = std::move(reader); }
    // A definition at file level begins.
    void begin_definition() { unclosed_ = false; }
    BlockStmt* block();
    // "[type] name (...) {...}"; null where there is no body.
    Function* function();
    // "[type] name (...) {" inside a block.
    bool at_function(uint32_t ahead = 0) const;
    Stmt* declaration_statement();

  private:
    Stmt* statement();
    Stmt* statement_unguarded();
    Stmt* body_statement();
    Stmt* empty_statement();
    Stmt* function_statement();
    Stmt* extern_statement();
    Stmt* expression_statement();
    Expr* effect();
    Expr* step(Expr* target, uint32_t at);
    void skip_grid_word();
    Expr* condition();
    void leave_header(uint32_t open);
    Stmt* if_statement();
    Stmt* lonely_else();
    Stmt* while_statement();
    Stmt* for_statement();
    std::span<Stmt*> for_initial();
    std::span<Expr*> for_step();
    Stmt* jump_statement(Word word);
    Stmt* return_statement();
    bool head(Stmt& node, std::span<Expr*>& args);
    Stmt* illuminance_statement();
    Stmt* illuminate_statement();
    Stmt* solar_statement();
    Stmt* gather_statement();

    template <class Node>
    Node* make(SourceSpan span) {
        return ast_.make<Node>(span);
    }

    Ast& ast_;
    TokenCursor& cursor_;
    SyntaxErrors& errors_;
    ForeignSyntax& foreign_;
    Nesting& nesting_;
    OpenDefinition& definition_;
    ExpressionParser& expressions_;
    DeclarationParser& declarations_;
    std::function<void()> local_struct_;
    bool unclosed_ = false;  // the end of the file or shader was met inside a block, and said
    bool skipped_ = false;   // the statement before was broken: it may have been an if
};

}  // namespace kinora::rsl
