// rsl/syntax/parse_object.h: classes and structs of RSL 2.0.
#pragma once

#include "rsl/syntax/ast.h"
#include "rsl/syntax/open_definition.h"
#include "rsl/syntax/parse_declaration.h"
#include "rsl/syntax/parse_statement.h"
#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

class ObjectParser {
  public:
    ObjectParser(Ast& ast, TokenCursor& cursor, SyntaxErrors& errors, OpenDefinition& open,
                 DeclarationParser& declarations, StatementParser& statements)
        : ast_(ast),
          cursor_(cursor),
          errors_(errors),
          open_(open),
          declarations_(declarations),
          statements_(statements) {}

    // "class name(" and "struct name {", where the words can be nothing else.
    bool at_class() const;
    bool at_struct() const;
    void class_definition();
    void struct_definition();

  private:
    bool accept_access();
    void items(std::vector<Stmt*>& members, std::vector<Function*>& methods);
    void item(std::vector<Stmt*>& members, std::vector<Function*>& methods);
    void no_item();
    bool same_struct_again(uint32_t begin);
    bool inherit(std::vector<Stmt*>& members, std::vector<Function*>& methods);
    void hide_overridden(std::span<Function*> methods, size_t first);

    Ast& ast_;
    TokenCursor& cursor_;
    SyntaxErrors& errors_;
    OpenDefinition& open_;
    DeclarationParser& declarations_;
    StatementParser& statements_;
};

}  // namespace kinora::rsl
