// rsl/syntax/parser.h: tokens to a syntax tree, by recursive descent: definitions hold statements,
// those declarations, those expressions. After an error the parser skips to the next statement or
// definition and says nothing until then.
#pragma once

#include "rsl/syntax/ast.h"
#include "rsl/syntax/nesting.h"
#include "rsl/syntax/open_definition.h"
#include "rsl/syntax/parse_declaration.h"
#include "rsl/syntax/parse_expression.h"
#include "rsl/syntax/parse_foreign.h"
#include "rsl/syntax/parse_object.h"
#include "rsl/syntax/parse_recovery.h"
#include "rsl/syntax/parse_statement.h"
#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

class Parser {
  public:
    // Reads the tokens from `first` on; its definitions are added to the tree's.
    Parser(Ast& ast, Reporter& reporter, uint32_t first = 0);
    void run();
    // What of the source is not in the tree.
    ParseRecovery& recovery() { return errors_.recovery(); }

  private:
    void definition();
    bool newer_definition();
    bool file_variable();
    bool shader_definition();
    bool at_co_shader() const;
    BlockStmt* shader_body(ShaderDefinition& shader);
    BlockStmt* body_as_function(BlockStmt* body);
    void function_definition();
    void unknown_definition();
    bool name_is_macro();

    Ast& ast_;
    TokenCursor cursor_;
    SyntaxErrors errors_;
    ForeignSyntax foreign_;
    Nesting nesting_;
    OpenDefinition open_;
    ExpressionParser expressions_;
    DeclarationParser declarations_;
    StatementParser statements_;
    ObjectParser objects_;
};

}  // namespace kinora::rsl
