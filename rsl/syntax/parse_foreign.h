// rsl/syntax/parse_foreign.h: what belongs to other languages or is misspelt: reported by what is
// meant, and read as that where it can be, so that nothing else is said of it.
#pragma once

#include <string_view>

#include "rsl/syntax/syntax_errors.h"
#include "rsl/syntax/token_cursor.h"

namespace kinora::rsl {

class ForeignSyntax {
  public:
    ForeignSyntax(TokenCursor& cursor, SyntaxErrors& errors) : cursor_(cursor), errors_(errors) {}

    // ---- types
    // "int i", "pont p": two names where a declaration could stand, or "const float a".
    bool at_type(int ahead = 0) const;
    // Reports it and takes it as the type that is meant; Invalid for a qualifier alone.
    bool accept_type(BaseType& base);
    // "(int) x", as in C: reported, and the value taken as it is.
    bool accept_cast();

    // ---- statements
    // Words of C before a function that say nothing here.
    bool accept_idle_word();
    // Statements of C that RSL does not have: an error.
    bool missing_statement();
    // "whlie (...) {": a name, parentheses and a statement, which are no function of untyped
    // parameters. Reported, and the name taken for the word.
    bool misspelt_statement();
    // The control word that a name of no meaning is probably meant to be; "" if none.
    std::string_view resembled_word() const;
    // "if (...) then": reported and left out.
    void accept_then();
    // "elseif" and its kin, behind the statement of an if: reported.
    bool at_else_if();

    // ---- operators
    // "a and b", "a or b": the operator that is meant; Punct::None elsewhere.
    Punct word_operator() const;
    // "not a", where no function or variable of the name can be meant: reported.
    bool at_not();

  private:
    TokenCursor& cursor_;
    SyntaxErrors& errors_;
};

}  // namespace kinora::rsl
