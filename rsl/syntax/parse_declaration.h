// rsl/syntax/parse_declaration.h: declarations of variables and parameters.
#pragma once

#include <span>

#include "rsl/syntax/ast.h"
#include "rsl/syntax/open_definition.h"
#include "rsl/syntax/parse_expression.h"
#include "rsl/syntax/parse_foreign.h"
#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

// What stands before the declared names.
struct DeclarationHead {
    Type type;  // Invalid for a struct's
    const StructDefinition* structure = nullptr;
    Detail detail = Detail::Unspecified;
    bool output = false;
    bool constant = false;
    bool handle = false;  // "shader": the type is Float
};

class DeclarationParser {
  public:
    DeclarationParser(Ast& ast, TokenCursor& cursor, SyntaxErrors& errors, ForeignSyntax& foreign,
                      ExpressionParser& expressions, OpenDefinition& definition)
        : ast_(ast),
          cursor_(cursor),
          errors_(errors),
          foreign_(foreign),
          expressions_(expressions),
          definition_(definition) {}

    // The struct of that name; null where there is none.
    const StructDefinition* find_struct(std::string_view name) const;
    // A struct's name before another name.
    const StructDefinition* struct_type(int ahead = 0) const;
    // A type before a name, or a detail. "float noise(P)" and "color (1,2,3)" are expressions.
    bool at_declaration() const;
    // "output uniform float" in any order, the type last. False after an error.
    bool read_head(DeclarationHead& head);
    // "a, b[3], c = 1": local variables.
    std::span<Symbol*> locals(const DeclarationHead& head);
    // "(float a = 1, b; color c)": groups begin with a type; ',' and ';' both separate.
    std::span<Symbol*> parameters(SymbolKind kind);

  private:
    Symbol* declarator(const DeclarationHead& head, SymbolKind kind);
    void array_suffix(Symbol& symbol);
    Expr* initialiser(Symbol& symbol);
    void end_of_parameters();
    bool is_parameter(uint32_t index) const;
    bool resume_parameters(uint32_t begin);

    Ast& ast_;
    TokenCursor& cursor_;
    SyntaxErrors& errors_;
    ForeignSyntax& foreign_;
    ExpressionParser& expressions_;
    OpenDefinition& definition_;
};

}  // namespace kinora::rsl
