// rsl/text/substitution.h: the replacement of one macro use.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "rsl/text/budget.h"
#include "rsl/text/macro_table.h"
#include "rsl/text/reporter.h"
#include "rsl/text/text_store.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

// Replaces the parameters in a macro's replacement, and does # and ##. Tokens of the replacement
// stand where the macro is used; tokens of arguments stay where they are.
class Substitution {
  public:
    // `name` is the token that uses the macro, `use` the index of that use in TokenStream::macros.
    Substitution(const Macro& macro, const std::vector<TokenList>& arguments, const Token& name,
                 uint32_t use, TextStore& texts, Budget& budget, Reporter& reporter);

    // `expand` expands the macros of an argument. Called once, for the result.
    TokenList run(const std::function<TokenList(const TokenList&)>& expand);

  private:
    void add(Token token);
    bool add_argument(const Token& parameter, size_t index, const TokenList& list, bool raw);
    Token stringise(const TokenList& tokens) const;
    std::optional<Token> paste(const Token& left, const Token& right) const;

    const Macro& macro_;
    const std::vector<TokenList>& arguments_;
    const Token& name_;
    TextStore& texts_;
    Budget& budget_;
    Reporter& reporter_;
    std::vector<std::optional<TokenList>> expanded_;  // of arguments, where needed
    Token at_;                                        // what tokens that are made here look like
    bool pasting_ = false;                            // a ## stands before the next token
    TokenList out_;
};

}  // namespace kinora::rsl
